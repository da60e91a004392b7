// SPDX-License-Identifier: Apache-2.0
#include "pace/drawing_pace.h"

#include <algorithm>
#include <cassert>

namespace theatron::pace {
namespace {

// When pictures take longer than `impatience` together, two of them decide instead of a full
// window: the faster one, because the first picture of a new mode also compiles shaders.
constexpr std::size_t least = 2;
constexpr Duration impatience = 600ms;
// A cheaper mode is kept if it takes at most this share of the time; else it only costs detail.
constexpr double worthwhile = 0.85;
// A failed return to a better mode is visible, so the next attempt waits twice as long.
constexpr Duration first_patience = 2s, longest_patience = 256s;
// The time of a mode that has not been tried, relative to the next cheaper one.
constexpr double unknown_times_as_long = 2;
// A return to a better mode counts as successful after this time.
constexpr Duration held = 60s;

}  // namespace

std::vector<DrawingWay> automatic_ways(std::size_t cameras, double scale) {
    std::vector<DrawingWay> ways;
    const double full = scale > 0 ? scale : 1;
    if (cameras >= 2)
        for (const int step : {1, 2})
            ways.push_back({"blend", step, full});
    for (const int step : {1, 2, 3})
        ways.push_back({"mesh", step, full});
    if (scale <= 0)
        for (const double fewer : {0.7, 0.5})
            ways.push_back({"mesh", 3, fewer});
    return ways;
}

std::size_t begin_without_gpu(const std::vector<DrawingWay>& ways) {
    const auto mesh = std::find_if(ways.begin(), ways.end(),
                                   [](const DrawingWay& way) { return way.renderer == "mesh"; });
    return mesh == ways.end() ? 0 : std::size_t(mesh - ways.begin());
}

std::size_t begin_with_headset(const std::vector<DrawingWay>& ways, const DrawingWay& now) {
    const auto found = std::find(ways.begin(), ways.end(), now);
    const std::size_t measured = found == ways.end() ? 0 : std::size_t(found - ways.begin());
    return std::max(measured, begin_without_gpu(ways));
}

std::vector<DrawingWay> ways_of(const std::string& renderer, double scale) {
    if (scale > 0)
        return {{renderer, 1, scale}};
    std::vector<DrawingWay> ways;
    for (const double each : {1.0, 0.75, 0.5, 0.35})
        ways.push_back({renderer, 1, each});
    return ways;
}

PaceLimits limits_of_display(double pictures_per_s) {
    const Duration each(std::int64_t(1e6 / pictures_per_s));
    return {each, each * 3 / 4};
}

DrawingPace::DrawingPace(std::vector<DrawingWay> ways, std::size_t begin, PaceLimits limits)
    : ways_(std::move(ways)), limits_(limits), current_(begin), patience_(first_patience) {
    assert(begin < ways_.size());
    for (std::size_t better = 0; better < begin; ++better)
        left_.push_back({better, unknown_times_as_long});
}

void DrawingPace::add(TimePoint now, Duration drawing) {
    if (changed_at_ == TimePoint{})
        changed_at_ = now;
    times_[count_++] = drawing;
    sum_ += drawing;
    const Duration median = median_when_enough();
    if (median == Duration{})
        return;
    if (trying_)
        judge_trial(median, now);
    if (trying_)
        return;
    if (came_up_ && now - changed_at_ > held) {
        came_up_ = false;
        patience_ = first_patience;
    }
    if (median > limits_.too_slow)
        leave_slow_way(median, now);
    else if (better_way_fits(median, now)) {
        const std::size_t better = left_.back().way;
        left_.pop_back();
        nothing_helps_ = false;
        go_to(better, now);
        came_up_ = true;
    }
}

// 0 while there are too few times.
Duration DrawingPace::median_when_enough() {
    if (count_ < window && (count_ < least || sum_ <= impatience))
        return {};
    const auto middle = times_.begin() + std::ptrdiff_t((count_ - 1) / 2);
    std::nth_element(times_.begin(), middle, times_.begin() + std::ptrdiff_t(count_));
    count_ = 0;
    sum_ = {};
    return std::max(*middle, Duration{1});
}

void DrawingPace::go_to(std::size_t way, TimePoint now) {
    current_ = way;
    changed_at_ = now;
    came_up_ = false;
    count_ = 0;
    sum_ = {};
}

void DrawingPace::leave_slow_way(Duration median, TimePoint now) {
    if (current_ + 1 == ways_.size() || nothing_helps_)
        return;
    if (came_up_)
        patience_ = std::min(2 * patience_, longest_patience);
    trying_ = true;
    tried_from_ = current_;
    before_ = median;
    go_to(current_ + 1, now);
}

// Ends the trial of a cheaper mode: keeps the mode, tries the next cheaper one, or goes back.
void DrawingPace::judge_trial(Duration median, TimePoint now) {
    const double times_as_long = double(before_.count()) / double(median.count());
    if (times_as_long * worthwhile >= 1) {
        trying_ = false;
        left_.push_back({tried_from_, times_as_long});
    } else if (current_ + 1 < ways_.size()) {
        go_to(current_ + 1, now);
    } else {
        trying_ = false;
        nothing_helps_ = true;
        go_to(tried_from_, now);
    }
}

bool DrawingPace::better_way_fits(Duration median, TimePoint now) const {
    return !left_.empty() && now - changed_at_ >= patience_ &&
           double(median.count()) * left_.back().times_as_long < double(limits_.has_room.count());
}

}  // namespace theatron::pace
