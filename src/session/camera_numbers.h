// SPDX-License-Identifier: Apache-2.0
// Numbers for the cameras of a session. All are used once before one is used again; then it is the
// one whose camera left longest ago, at least `rest` ago: nobody has messages of that camera any
// more, a recorder that takes nothing is cut off long before, and the past forgets a camera as it
// leaves. So there are always numbers, however often cameras come and go.
//
// Pure; time is passed in.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <deque>

#include "base/ids.h"
#include "base/time.h"
#include "session/announced_cameras.h"

namespace theatron::session {

class CameraNumbers {
public:
    static constexpr Duration rest = std::chrono::minutes(10);

    // Time goes on.
    void on_time(TimePoint now) { now_ = std::max(now_, now); }

    // The number of the next camera, or of the one `further` behind it. Needs has(further + 1).
    CameraId next(std::size_t further) const {
        assert(has(further + 1));
        return further < never_used() ? CameraId(first_unused_ + int(further))
                                      : left_[further - never_used()].camera;
    }
    bool has(std::size_t cameras) const {
        return cameras <= never_used() || (cameras - never_used() <= left_.size() &&
                                           is_rested(left_[cameras - never_used() - 1]));
    }
    // The numbers below this one are given out by somebody else. Before the first take().
    void keep(int below) { first_unused_ = std::max(first_unused_, below); }
    // Gives out next(0).
    CameraId take() {
        const CameraId taken = next(0);
        if (never_used() > 0)
            ++first_unused_;
        else
            left_.pop_front();
        return taken;
    }
    // The camera has left.
    void give_back(CameraId camera) { left_.push_back({camera, now_}); }
    // A camera had this number once, or has it.
    bool was_given(CameraId camera) const { return int(camera) < first_unused_; }

private:
    struct Left {
        CameraId camera{};
        TimePoint when;
    };
    std::size_t never_used() const { return std::size_t(max_camera_number + 1 - first_unused_); }
    bool is_rested(const Left& left) const { return now_ - left.when >= rest; }

    TimePoint now_;
    int first_unused_ = 0;
    std::deque<Left> left_;  // in the order of leaving
};

}  // namespace theatron::session
