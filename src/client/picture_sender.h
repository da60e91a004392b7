// SPDX-License-Identifier: Apache-2.0
// Sends pictures that a browser takes and encodes: of this person's face (wire::CameraKind::face),
// or of a screen (CameraKind::screen). Every picture is a JPEG of its own.
//
// Thread safe.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client/participant.h"

namespace theatron::client {

class PictureSender {
public:
    // The camera to offer with Participant::publish_face().
    static wire::OfferedCamera face(Size picture, double frames_per_second);
    // The same with Participant::show_screen(). `name`: what others read above it.
    static wire::OfferedCamera screen(const std::string& name, Size picture,
                                      double frames_per_second);

    // For Participant::Options::face or ::screen; valid as long as this.
    Participant::Publishing events();
    // The host has taken the camera, and somebody gets it or may.
    bool is_taken() const;
    // Somebody has ended it for all, since the last call.
    bool take_ended();

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
    bool has_ended_ = false;
};

}  // namespace theatron::client
