// SPDX-License-Identifier: Apache-2.0
// A camera that is sent into a session, whose frames the caller gives. Thread safe; no function
// needs Python's lock.
#pragma once

#include <memory>
#include <string>

#include "capture/pushed_camera.h"
#include "image/frame_pool.h"
#include "publish/camera_publisher.h"

namespace theatron::python {

class SentCamera {
public:
    struct Options {
        std::string link;    // for those who may send
        std::string person;  // shown in the session
        capture::CameraInfo info;
        bool may_record = false;
    };
    // Begins to connect. Throws Error if the link or the name is wrong.
    explicit SentCamera(const Options& options);
    ~SentCamera();

    // Waits at most a tenth of a second. True once the session has the camera. Throws Error if the
    // session refuses it, or has ended.
    bool is_in_session();

    // A frame to be filled, whose memory is used again.
    std::shared_ptr<Frame> empty_frame() { return pool_.take(); }
    // Sends a frame that was captured `age` ago. Throws Error if it does not fit the calibration,
    // and as is_in_session().
    void send(std::shared_ptr<Frame> frame, Duration age);

    // Somebody gets its pictures now.
    bool is_wanted() const;
    // Frames that were taken to be encoded, and those that a newer one replaced before.
    std::uint64_t taken() const;
    std::uint64_t replaced() const { return frames_->replaced(); }

private:
    void require_session() const;

    FramePool pool_;
    const std::shared_ptr<capture::PushedFrames> frames_;
    publish::CameraPublisher publisher_;
    client::Participant participant_;
    const publish::Publishing publishing_;
};

}  // namespace theatron::python
