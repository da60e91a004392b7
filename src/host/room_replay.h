// SPDX-License-Identifier: Apache-2.0
// Replays the room of a recording whose cameras a host plays: at each moment tells what has
// changed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "capture/recorded_room.h"
#include "capture/recorded_voices.h"
#include "capture/transport.h"

namespace theatron::host {

// The recording that a host plays, with its room if that was recorded.
struct PlayedRecording {
    std::shared_ptr<const record::RecordingFile> recording;
    std::string file;        // as the camera's specification names it
    std::size_t camera = 0;  // the first of the host's cameras that plays it, if it has cameras
    // For all of the host's cameras that play it, and for its room.
    std::shared_ptr<capture::Transport> transport;
};
// The recording of the first of these camera specifications that plays one; those whose room was
// recorded come first. Empty if there is none. Throws Error for a file that cannot be read.
std::optional<PlayedRecording> find_played_recording(
    const std::vector<std::string>& specifications);
// The specifications without those of a recording that has no cameras, only a room.
std::vector<std::string> without_room_only(const std::optional<PlayedRecording>& played,
                                           const std::vector<std::string>& specifications);
// True for a camera of the same recording.
bool plays(const PlayedRecording& played, const std::string& specification);
// The number in the recording of the camera that such a specification names.
std::size_t camera_in_recording(const std::string& specification);

class RoomReplay {
public:
    // Shortest time between two calls of `show`: a period of poses (session/pose_board.h).
    static constexpr Duration period = Duration(11'111);

    struct Change {
        session::RoomObjects objects;  // all, with recorded numbers
        // Poses that are new, with recorded numbers and the present time; and people without one.
        std::vector<std::pair<ParticipantId, Bytes>> poses;
        std::vector<ParticipantId> left;
    };
    // A packet of voice (voice/packet.h) of a person with a recorded number, with present times.
    struct Speech {
        ParticipantId person{};
        Bytes packet;
    };

    // Begins when `has_begun` is true for the first time. Calls all functions from its own thread.
    RoomReplay(PlayedRecording played, std::function<bool()> has_begun,
               std::function<void(Change)> show, std::function<void(std::vector<Speech>)> speak);
    ~RoomReplay();

private:
    void run();
    void play(TimePoint now);
    Change change(TimePoint now);
    // The speech up to the position at `now`. After a jump or a pause it goes on at the position.
    void play_voices(const capture::Transport::State& state, TimePoint now);

    const PlayedRecording source_;
    const std::function<bool()> has_begun_;
    const std::function<void(Change)> show_;
    const std::function<void(std::vector<Speech>)> speak_;
    capture::RecordedRoom room_;
    capture::RecordedVoices voices_;
    // Changes and rounds of the transport that the voices follow, and where the recording's
    // beginning is since then.
    std::optional<std::pair<std::uint64_t, std::uint64_t>> voices_follow_;
    TimePoint voices_zero_;
    session::PoseBodies shown_;
    TimePoint repeated_{};  // when a paused room was last shown anew
    std::atomic<bool> stopping_ = false;
    std::thread thread_;
};

}  // namespace theatron::host
