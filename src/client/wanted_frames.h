// SPDX-License-Identifier: Apache-2.0
// The frames that a decoding worker hands on. Their copies cost a page time, so that a page which
// draws less often than frames come asks for those that it will draw.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "receive/receiver.h"

namespace theatron::client {

class WantedFrames {
public:
    // A frame was decoded. True if it is to be handed on now, as all are before the first want();
    // else it waits, and replaces the one of its camera that waited.
    bool add(const receive::CameraFramePtr& frame) {
        if (!on_demand_ || served_.insert(frame->camera).second) {
            waiting_.erase(frame->camera);
            return true;
        }
        waiting_[frame->camera] = frame;
        return false;
    }

    // The next frame of each camera is wanted. Those that wait are to be handed on now.
    std::vector<receive::CameraFramePtr> want() {
        on_demand_ = true;
        served_.clear();
        std::vector<receive::CameraFramePtr> frames;
        for (auto& [camera, frame] : std::exchange(waiting_, {})) {
            served_.insert(camera);
            frames.push_back(std::move(frame));
        }
        return frames;
    }

    // There are other cameras: all their frames, until they are wanted.
    void begin_anew() { *this = {}; }
    // The camera is gone or has another calibration.
    void forget(CameraId camera) {
        waiting_.erase(camera);
        served_.erase(camera);
    }

private:
    bool on_demand_ = false;
    std::set<CameraId> served_;  // since the last want()
    std::map<CameraId, receive::CameraFramePtr> waiting_;
};

}  // namespace theatron::client
