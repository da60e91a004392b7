// SPDX-License-Identifier: Apache-2.0
#include "pace/drawing_rest.h"

#include <algorithm>

namespace theatron::pace {

void DrawingRest::add(TimePoint begun, Duration processor) {
    constexpr double newest_share = 0.2;
    constexpr Duration longest(std::int64_t(1e6 / fewest_per_second));
    if (begun_ && begun > *begun_) {
        // As if the next picture had begun without rest.
        const Duration rest = std::max(next_ - *begun_ - took_, Duration{});
        const Duration apart = std::max(begun - *begun_ - rest, Duration(1));
        const double share = std::min(1.0, double(took_.count()) / double(apart.count()));
        share_ += (share_ > 0 ? newest_share : 1) * (share - share_);
    }
    begun_ = begun;
    took_ = processor;
    const Duration whole(std::int64_t(double(processor.count()) / shares[step_]));
    next_ = begun + std::max(processor, std::min(whole, longest));
}

void DrawingRest::observe(const Receiving& receiving, TimePoint now) {
    if (stepped_ == TimePoint{})
        stepped_ = now;
    if (receiving.is_behind)
        calm_since_.reset();
    else if (!calm_since_)
        calm_since_ = now;
    if (came_up_ && now - stepped_ >= held) {
        came_up_ = false;
        patience_ = first_patience;
    }
    if (is_too_much(receiving)) {
        go_down(receiving, now);
    } else if (receiving.is_behind && now - stepped_ >= settling) {
        if (step_ + 1 < shares.size())
            go_down(receiving, now);
        else
            judge(receiving, now);
    } else if (step_ > 0 && calm_since_ && now - std::max(*calm_since_, stepped_) >= patience_) {
        go(step_ - 1, now);
        came_up_ = true;
        if (step_ == 0)
            before_.reset();
    }
}

bool DrawingRest::is_too_much(const Receiving& receiving) {
    if (came_up_)
        return age_ms_ > 0 && receiving.age_ms > times_as_old * age_ms_ + more_ms;
    if (!receiving.is_behind && receiving.age_ms > 0)
        age_ms_ += (age_ms_ > 0 ? 0.1 : 1) * (receiving.age_ms - age_ms_);
    return false;
}

void DrawingRest::go(std::size_t step, TimePoint now) {
    step_ = step;
    stepped_ = now;
    came_up_ = false;
}

void DrawingRest::go_down(const Receiving& receiving, TimePoint now) {
    if (now < not_before_ || !draws_much())
        return;
    if (came_up_)
        patience_ = std::min(2 * patience_, longest_patience);
    if (!before_)
        before_ = receiving.frames_per_second;
    go(step_ + 1, now);
}

// Frames are left out although little is drawn.
void DrawingRest::judge(const Receiving& receiving, TimePoint now) {
    if (now - stepped_ < proof || (before_ && receiving.frames_per_second >= gain * *before_))
        return;
    if (before_) {
        not_before_ = now + pause_;
        pause_ = std::min(2 * pause_, longest_pause);
    }
    go(0, now);
    before_.reset();
}

}  // namespace theatron::pace
