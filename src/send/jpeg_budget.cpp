// SPDX-License-Identifier: Apache-2.0
#include "send/jpeg_budget.h"

#include <algorithm>

namespace theatron::send {
namespace {

// Sizes as in host/codec_steps.cpp; half the width and height takes about a third of the bytes.
constexpr JpegBudget::Step all_steps[] = {
    {85, 1, 1},    {80, 1, 0.9},  {75, 1, 0.82}, {70, 1, 0.72}, {65, 1, 0.63},
    {60, 1, 0.56}, {55, 1, 0.51}, {50, 1, 0.47}, {45, 1, 0.43}, {40, 1, 0.4},
    {35, 1, 0.37}, {30, 1, 0.34}, {25, 1, 0.3},  {60, 2, 0.18}, {40, 2, 0.13},
    {25, 2, 0.1},  {60, 4, 0.06}, {40, 4, 0.04}, {25, 4, 0.03},
};

constexpr std::size_t whole_steps = 13;  // of the whole size
static_assert(all_steps[whole_steps - 1].divisor == 1 && all_steps[whole_steps].divisor > 1);

// Shares of the bound that a picture is expected to take: with a step that is coarser, so that the
// picture need not be encoded a third time, and with one that is finer, so that it holds.
constexpr double goal_down = 0.95, goal_up = 0.9;
constexpr double own_calm_share = 0.9;

}  // namespace

JpegBudget::JpegBudget(const JpegLimits& limits)
    : steps_(limits.may_be_smaller ? std::span(all_steps)
                                   : std::span(all_steps).first(whole_steps)),
      most_bytes_(std::size_t(most_mbit * 1e6 / 8 / std::max(limits.frames_per_second, 1.0))) {}

bool JpegBudget::takes_own(std::size_t bytes) {
    own_calm_ = fits(double(bytes), own_calm_share) ? std::min(own_calm_ + 1, first_wait) : 0;
    own_fits_ = bytes <= most_bytes_ && (own_fits_ || own_calm_ == first_wait);
    return own_fits_;
}

bool JpegBudget::takes(std::size_t bytes) {
    const auto expected = [&](std::size_t step) {
        return double(bytes) * steps()[step].size / steps()[step_].size;
    };
    if (bytes > most_bytes_ && step_ + 1 < steps().size()) {
        wait_ = since_try_ < longest_wait ? std::min(2 * wait_, longest_wait) : first_wait;
        since_try_ = longest_wait;
        std::size_t coarser = step_ + 1;
        while (coarser + 1 < steps().size() && !fits(expected(coarser), goal_down))
            ++coarser;
        step_ = coarser;
        calm_ = 0;
        return false;
    }
    since_try_ = std::min(since_try_ + 1, longest_wait);
    calm_ = step_ > 0 && fits(expected(step_ - 1), goal_up) ? calm_ + 1 : 0;
    if (calm_ >= wait_) {
        --step_;
        calm_ = 0;
        since_try_ = 0;
    }
    return true;
}

}  // namespace theatron::send
