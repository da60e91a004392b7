// SPDX-License-Identifier: Apache-2.0
// The moments of cameras that run on threads of their own.
#pragma once

#include <mutex>

#include "capture/moments.h"

namespace theatron::send {

class SharedMoments {
public:
    explicit SharedMoments(double frames_per_second) : moments_(frames_per_second) {}

    capture::Moments::Tag tag(CameraId camera, TimePoint captured) {
        const std::lock_guard lock(mutex_);
        return moments_.tag(camera, captured);
    }

private:
    std::mutex mutex_;
    capture::Moments moments_;
};

}  // namespace theatron::send
