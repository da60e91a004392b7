// SPDX-License-Identifier: Apache-2.0
// Ends the tracks of a microphone, webcam or screen, so that the browser's sign of them goes out. `stream` may be null, or an
// object in the place of one that the browser has not given yet.
export function stop_tracks(stream) {
    for (const track of stream?.getTracks?.() ?? [])
        track.stop();
}
