// SPDX-License-Identifier: Apache-2.0
// Groups the frames of several cameras by moment. Pure: times are passed in.
//
// Free-running cameras drift relative to each other. One of them, the first that runs, is the
// leader: each of its frames defines a moment. A frame of another camera belongs to the
// nearest moment, at most half a frame away. A camera that is slightly faster sometimes has
// two frames in a moment, and the second is skipped; a slower camera sometimes has none.
//
// Cameras that are synchronised by a cable stay together at any phase, because the beat
// follows one of them and not a clock.
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
        std::int64_t index = 0;  // number of the moment; negative before the first frame
        TimePoint moment;        // equal for equal indices
        Duration offset{};       // captured - moment
        bool pass_over = false;  // the camera already has a frame in this moment
    };
    // Assigns a frame of `camera` to a moment. Frames of one camera come in order.
    Tag tag(CameraId camera, TimePoint captured);

private:
    // A leader that has been silent for this long is replaced.
    static constexpr Duration leader_patience = 200ms;
    static constexpr std::size_t remembered = 64;

    TimePoint estimate(std::int64_t index) const;
    TimePoint time_of(std::int64_t index) const;

    double period_us_;
    bool begun_ = false;
    CameraId leader_{};
    // The leader's last frame, which defines the beat.
    std::int64_t beat_index_ = 0;
    TimePoint beat_time_;
    std::map<CameraId, std::int64_t> last_index_;
    // Times already returned for moments, so that all cameras get equal times, including
    // those whose pictures come a second late.
    struct Told {
        std::int64_t index = -1'000'000'000;
        TimePoint time;
    };
    std::array<Told, remembered> told_;
};

}  // namespace theatron::capture
