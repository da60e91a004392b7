// SPDX-License-Identifier: Apache-2.0
// Shows the frames of several cameras together that belong to one moment (CameraFrame::moment,
// which the host makes equal for them).
//
// A frame waits a short time for those of the other cameras. Nothing waits for a camera whose
// frames usually come much later than the first of their moment, as those of a camera that runs out
// of phase, or for one that misses many moments. Pure: times are passed in.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "receive/receiver.h"

namespace theatron::viewer {

// Not thread safe.
class SameMoment {
public:
    // A frame arrived. Frames of the past are shown at once.
    void add(receive::CameraFramePtr frame, TimePoint now);
    // A camera that is gone; the others do not wait for it.
    void remove(CameraId camera);

    // The frames to show from now on, at most one of a camera, each newer than the one of its
    // camera that was shown before.
    std::vector<receive::CameraFramePtr> take(TimePoint now);
    // Frames wait for those of other cameras: take() must be called again soon.
    bool waits() const;

    // The time between the first and the last exposure of the live frames that are shown; nullopt
    // with fewer than two cameras.
    std::optional<Duration> skew(TimePoint now) const;

private:
    // A frame waits at most this long, and only for cameras that are usually this late at most, so
    // that the median age grows by no more.
    static constexpr Duration patience = std::chrono::milliseconds(12);
    static constexpr Duration usual_lateness = std::chrono::milliseconds(5);
    // A camera without a frame for this long is not live.
    static constexpr Duration silence = std::chrono::milliseconds(250);
    // Moments that are remembered of each camera, and the number of them that it may miss.
    static constexpr std::size_t remembered = 16, may_miss = 4;
    // Moments for which frames may still come.
    static constexpr std::size_t open_moments = 4;

    struct Arrived {
        receive::CameraFramePtr frame;
        TimePoint at;
    };
    struct Camera {
        std::deque<Arrived> waiting;                   // oldest first
        receive::CameraFramePtr shown;                 // null before the first
        TimePoint arrived_at{};                        // of the newest frame
        std::deque<std::optional<Duration>> lateness;  // by moment; nullopt: no frame came
    };
    struct Moment {
        TimePoint moment, first_at;
        std::map<CameraId, TimePoint> arrivals;
    };

    bool is_live(const Camera& camera, TimePoint now) const;
    bool is_waited_for(const Camera& camera, TimePoint now) const;
    bool has_or_had(const Camera& camera, TimePoint moment) const;
    void note_arrival(CameraId camera, TimePoint moment, TimePoint now);
    void close_moment();

    std::map<CameraId, Camera> cameras_;
    std::deque<Moment> moments_;  // oldest first
};

}  // namespace theatron::viewer
