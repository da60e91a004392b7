// SPDX-License-Identifier: Apache-2.0
// One receiver of a session's streams: the codecs that it wishes, and how much it is sent. A pure
// state machine.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/ids.h"
#include "session/camera_streams.h"
#include "session/delivery.h"
#include "wire/control.h"

namespace theatron::session {

// Codecs in canonical spelling.
struct CodecWish {
    std::string depth, color;
    const std::string& of(bool is_depth) const { return is_depth ? depth : color; }
    bool operator==(const CodecWish&) const = default;
};

struct StreamReceiver {
    CodecWish wish;
    std::map<CameraId, CodecWish> wishes;  // for single cameras; empty texts: as `wish`
    CodecWish fixed;                       // instead of both, by a study; empty texts: none
    bool records = false, takes_faces = false;
    std::uint32_t max_kbit_per_s = 0;  // 0: no ceiling
    bool is_by_relay = false;          // see Streams
    std::set<CameraId> past;           // that it is shown the past of
    Delivery delivery;

    // True if it gets this camera, as the participant `id`.
    bool gets(const CameraStreams& camera, ParticipantId id) const {
        return camera.is_for(id, takes_faces, records);
    }
    const std::string& wished(CameraId camera, bool depth) const;
    // An empty text keeps the codec. Empty `cameras`: for all, also for later ones.
    void choose(const CodecWish& chosen, const std::vector<CameraId>& cameras);
    // Instead of all that was chosen, which comes back where a text is empty.
    void fix(const CodecWish& codecs);
    // Puts the wished codec of this camera into its table.
    void request(CameraStreams& camera, ParticipantId id, bool depth) const;
    const LadderStep& step_for(const CameraStreams& camera, ParticipantId id);
    // Puts the encodings of its step into the camera's tables.
    void take_step(CameraStreams& camera, ParticipantId id);
    // Empty if it gets the settings that it requested. It requests none for faces.
    wire::Text note_on(const CameraStreams& camera, ParticipantId id);
    // No stream of this camera is sent to it any more.
    void forget(CameraId camera);

private:
    void tell_delivery();
};

}  // namespace theatron::session
