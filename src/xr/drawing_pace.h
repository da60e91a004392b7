// SPDX-License-Identifier: Apache-2.0
// How much work goes into a picture, so that looking around stays fluent on a slow machine: the
// best way of drawing that keeps up.
//
// A pure state machine, fed with how long pictures took.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/time.h"

namespace theatron::xr {

// A way of drawing the clouds.
struct DrawingWay {
    std::string renderer;
    int depth_step = 1;  // see render::CloudSet::set_depth_step
    double scale = 1;    // of the window's pixels, on each side

    bool operator==(const DrawingWay&) const = default;
};

// The ways among which there is a choice, best first. With `scale` above 0 that many pixels are
// drawn in all of them.
//
// For a viewer who left the renderer to us: "blend" where there are two cameras and more, then
// "mesh", each with all points before it is drawn with fewer; last with fewer pixels. Colour keeps
// its sharpness with fewer points, so that "blend" with a quarter of them is better to look at than
// "mesh" with all. Which is quicker depends on the driver.
std::vector<DrawingWay> automatic_ways(std::size_t cameras, double scale);
// For one who wants this renderer: fewer pixels, nothing else.
std::vector<DrawingWay> ways_of(const std::string& renderer, double scale);

class DrawingPace {
public:
    // At least one way; begins with the first.
    explicit DrawingPace(std::vector<DrawingWay> ways);

    const std::vector<DrawingWay>& ways() const { return ways_; }
    const DrawingWay& way() const { return ways_[current_]; }

    // A picture is shown at `now` and took so long, from its beginning to its presentation. On a
    // GPU drawing runs behind, but the driver lets only a few pictures queue up and then makes the
    // presentation wait: where it cannot keep up, this is its time for a picture, without asking.
    // Waiting for the screen counts, too: at most its 17 ms (33 ms at 30 Hz), which is in time.
    void add(TimePoint now, Duration drawing);

private:
    static constexpr std::size_t window = 8;

    Duration median_when_enough();
    void go_to(std::size_t way, TimePoint now);
    void leave_slow_way(Duration median, TimePoint now);
    void judge_trial(Duration median, TimePoint now);
    bool better_way_fits(Duration median, TimePoint now) const;

    std::vector<DrawingWay> ways_;
    std::size_t current_ = 0;

    std::array<Duration, window> times_{};
    std::size_t count_ = 0;
    Duration sum_{};

    // The way that was too slow, while another one is tried instead of it.
    bool trying_ = false;
    std::size_t tried_from_ = 0;
    Duration before_{};
    bool nothing_helps_ = false;

    // What was left for being too slow, last one last, and how many times as long it took as what
    // came instead.
    struct Left {
        std::size_t way;
        double times_as_long;
    };
    std::vector<Left> left_;

    TimePoint changed_at_{};
    bool came_up_ = false;  // to this way, from a worse one
    Duration patience_;     // before the next attempt to go up
};

}  // namespace theatron::xr
