// SPDX-License-Identifier: Apache-2.0
// Sends the picture of this person's face (wire::CameraKind::face) where a browser takes and
// encodes it: every picture is a JPEG of its own.
//
// Thread safe.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "client/participant.h"

namespace theatron::client {

class FaceSender {
public:
    // The camera to offer with Participant::publish_face().
    static wire::OfferedCamera offer(Size picture, double frames_per_second);

    // For Participant::Options::face; valid as long as this.
    Participant::Publishing events();
    // The host has taken the face, and somebody gets it or may.
    bool is_taken() const;

    struct Media {
        wire::MediaHeader header;
        std::shared_ptr<const Bytes> message;
    };
    // A picture of the offered size, captured and encoded at these times of the session, for each
    // stream that the host wants. Nothing for settings that this cannot encode.
    std::vector<Media> messages(ByteView jpeg, TimePoint captured, TimePoint encoded);
    void send(Participant& participant, ByteView jpeg, TimePoint captured);

private:
    mutable std::mutex mutex_;
    std::vector<CameraId> numbers_;
    std::vector<wire::StreamSetting> settings_;
    FrameNumber frame_ = 0;
};

}  // namespace theatron::client
