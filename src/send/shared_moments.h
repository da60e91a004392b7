// SPDX-License-Identifier: Apache-2.0
// The moments of cameras that run on threads of their own, and figures of their pictures.
#pragma once

#include <mutex>

#include "base/moment_meter.h"
#include "capture/moments.h"

namespace theatron::send {

class SharedMoments {
public:
    explicit SharedMoments(double frames_per_second) : moments_(frames_per_second) {}

    // `compared`: of a camera of the room, not a screen.
    capture::Moments::Tag tag(CameraId camera, TimePoint captured, bool compared) {
        const std::lock_guard lock(mutex_);
        const capture::Moments::Tag tag = moments_.tag(camera, captured);
        if (compared && !tag.pass_over)
            meter_.add(ParticipantId{}, camera, tag.moment, captured);
        return tag;
    }
    // A picture of another publisher, in its own moments.
    void note(ParticipantId publisher, CameraId camera, TimePoint moment, TimePoint captured) {
        const std::lock_guard lock(mutex_);
        meter_.add(publisher, camera, moment, captured);
    }
    MomentFigures figures() const {
        const std::lock_guard lock(mutex_);
        return meter_.figures();
    }

private:
    mutable std::mutex mutex_;
    capture::Moments moments_;
    MomentMeter meter_;
};

}  // namespace theatron::send
