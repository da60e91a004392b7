// SPDX-License-Identifier: Apache-2.0
// Which frames of several cameras belong together. Pure: times are passed in.
//
// Cameras that run freely drift past each other. One of them, the first that
// runs, sets the beat: each of its frames is a moment. A frame of another camera
// belongs to the moment that is nearest, at most half a frame away. A camera that
// is a little faster than the beat has now and then two frames in a moment, and
// the second is passed over; a slower one leaves a moment out.
//
// Cameras that are synchronised by a cable stay together whatever their phase is,
// because the beat is one of theirs and not a clock's.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "base/ids.h"
#include "base/time.h"

namespace theatron::capture {

// Not thread safe.
class Moments {
public:
    // `frames_per_second`: nominal, of the fastest camera.
    explicit Moments(double frames_per_second);

    struct Tag {
        std::int64_t index = 0;  // counts moments; -1, -2, … before the first frame's
        TimePoint moment;        // equal for equal indices
        Duration offset{};       // captured - moment
        bool pass_over = false;  // this camera already has a frame in this moment
    };
    // A frame of `camera`. Frames of one camera come in order.
    Tag tag(CameraId camera, TimePoint captured);

private:
    // A leader that has been silent for this long is followed no more.
    static constexpr Duration leader_patience = 200ms;
    static constexpr std::size_t remembered = 64;

    TimePoint estimate(std::int64_t index) const;
    TimePoint time_of(std::int64_t index) const;

    double period_us_;
    bool begun_ = false;
    CameraId leader_{};
    // The leader's last frame: where the beat is.
    std::int64_t beat_index_ = 0;
    TimePoint beat_time_;
    std::map<CameraId, std::int64_t> last_index_;
    // Moments whose time has been told, so that all cameras are told the same, those
    // included whose pictures come a second late.
    struct Told {
        std::int64_t index = -1'000'000'000;
        TimePoint time;
    };
    std::array<Told, remembered> told_;
};

}  // namespace theatron::capture
