// SPDX-License-Identifier: Apache-2.0
// Chooses how much work goes into a picture, so that the view moves fluently on a slow machine: the
// best drawing mode that is fast enough.
//
// A pure state machine; its input is the drawing time of each picture.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/time.h"

namespace theatron::pace {

// A mode of drawing the clouds.
struct DrawingWay {
    std::string renderer;
    int depth_step = 1;  // see render::CloudSet::set_depth_step
    double scale = 1;    // of the window's pixels, on each side

    bool operator==(const DrawingWay&) const = default;
};

// The modes to choose from, best first. A `scale` above 0 is the scale of all of them; 0 leaves
// the scale to the choice.
//
// For the renderer "auto": "blend" if there are at least two cameras, then "mesh", each with all
// points first and then with fewer; last with fewer pixels. Colour keeps its sharpness with fewer
// points, so that "blend" with a quarter of the points shows more detail than "mesh" with all.
// The driver decides which of these two is faster.
std::vector<DrawingWay> automatic_ways(std::size_t cameras, double scale);
// The place in automatic_ways() where a machine without a graphics card begins: the first "mesh".
std::size_t begin_without_gpu(const std::vector<DrawingWay>& ways);
// The same for a headset, for which each picture must be there in time: the first "mesh", or `now`,
// in which the window was drawn, if that is a cheaper one.
std::size_t begin_with_headset(const std::vector<DrawingWay>& ways, const DrawingWay& now);
// For a renderer that the viewer chose: fewer pixels, nothing else.
std::vector<DrawingWay> ways_of(const std::string& renderer, double scale);

// Drawing times above `too_slow` lead to a cheaper mode; a better one is tried again if its
// expected time is below `has_room`, which is clearly less.
struct PaceLimits {
    Duration too_slow = 40ms, has_room = 30ms;
};
// For a display that shows `pictures_per_s` and has to get each of them in time.
PaceLimits limits_of_display(double pictures_per_s);

class DrawingPace {
public:
    // `ways` has at least one mode; the one at `begin` is the current one at the beginning. Better
    // ones are tried when there seems to be time for them.
    explicit DrawingPace(std::vector<DrawingWay> ways, std::size_t begin = 0,
                         PaceLimits limits = {});

    const std::vector<DrawingWay>& ways() const { return ways_; }
    const DrawingWay& way() const { return ways_[current_]; }

    // Call after each picture, shown at `now`; `drawing` is the time from its beginning to its
    // presentation. A GPU draws later, but the driver queues only a few pictures and then blocks
    // the presentation: if the GPU is too slow, `drawing` is its time for a picture.
    // Waiting for the screen counts too: at most 17 ms (33 ms at 30 Hz), which is below the limit.
    void add(TimePoint now, Duration drawing);

private:
    static constexpr std::size_t window = 8;

    Duration median_when_enough();
    void go_to(std::size_t way, TimePoint now);
    void leave_slow_way(Duration median, TimePoint now);
    void judge_trial(Duration median, TimePoint now);
    bool better_way_fits(Duration median, TimePoint now) const;

    std::vector<DrawingWay> ways_;
    PaceLimits limits_;
    std::size_t current_ = 0;

    std::array<Duration, window> times_{};
    std::size_t count_ = 0;
    Duration sum_{};

    // During a trial of a cheaper mode: the mode that was too slow, and its median time.
    bool trying_ = false;
    std::size_t tried_from_ = 0;
    Duration before_{};
    bool nothing_helps_ = false;

    // Stack of the modes that were abandoned as too slow, with their time relative to that of the
    // mode that replaced them.
    struct Left {
        std::size_t way;
        double times_as_long;
    };
    std::vector<Left> left_;

    TimePoint changed_at_{};
    bool came_up_ = false;  // the last change was to a better mode
    Duration patience_;     // before the next attempt to go up
};

}  // namespace theatron::pace
