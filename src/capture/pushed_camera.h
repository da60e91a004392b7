// SPDX-License-Identifier: Apache-2.0
// A camera whose frames another part of the program gives: a driver that this library does not
// know, or arrays of a script.
//
//     const auto frames = std::make_shared<PushedFrames>(info);
//     publish::CameraPublisher publisher(..., make_pushed_camera(frames));
//     frames->push(std::move(frame), captured);
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "capture/camera.h"

namespace theatron::capture {

// The end that gives. Thread safe.
class PushedFrames {
public:
    // `info` describes all frames. CameraInfo::live should be false unless no two pictures are
    // equal.
    explicit PushedFrames(CameraInfo info) : info_(std::move(info)) {}

    const CameraInfo& info() const { return info_; }

    // Gives a frame, whose number is counted here, captured at this time of the steady clock. It
    // replaces one that the camera has not taken yet. Returns a sentence about what is wrong with
    // it, and the frame is left out then; empty: nothing. Depth and colour, if there is any, have
    // the sizes of the calibration.
    std::string push(std::shared_ptr<Frame> frame, TimePoint captured);

    // No further frame comes: the camera ends, with this sentence for the user if something is
    // wrong.
    void end(std::string problem = "");

    // As Camera::next(). For the camera.
    Capture take(Duration timeout);

    // Frames that were replaced.
    std::uint64_t replaced() const;

private:
    const CameraInfo info_;
    mutable std::mutex mutex_;  // guards all below
    std::condition_variable changed_;
    std::shared_ptr<Frame> waiting_;
    std::optional<TimePoint> last_captured_;
    FrameNumber number_ = 0;
    std::uint64_t replaced_ = 0;
    bool has_ended_ = false;
    std::string problem_;
};

// The end that a lane or a loop reads.
std::unique_ptr<Camera> make_pushed_camera(std::shared_ptr<PushedFrames> frames);

}  // namespace theatron::capture
