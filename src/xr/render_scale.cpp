// SPDX-License-Identifier: Apache-2.0
#include "xr/render_scale.h"

#include <algorithm>

namespace theatron::xr {
namespace {

constexpr Duration too_slow = 50ms;
// Where pictures take so long that nobody would wait for a whole window of them, fewer decide.
constexpr std::size_t least = 3;
constexpr Duration patience = 600ms;
// The next finer step has at most 2.3 times the pixels, so this cannot swing to and fro.
constexpr Duration fast_enough = 20ms;
// Points cost much by themselves: a coarser picture that saves less than this share
// of the time only looks worse.
constexpr double worthwhile = 0.85;

}  // namespace

void RenderScale::add(Duration drawing) {
    times_[count_++] = drawing;
    sum_ += drawing;
    const bool enough = count_ == window || (count_ >= least && sum_ > patience);
    if (!enough)
        return;
    const auto middle = times_.begin() + std::ptrdiff_t(count_ / 2);
    std::nth_element(times_.begin(), middle, times_.begin() + std::ptrdiff_t(count_));
    const Duration median = *middle;
    count_ = 0;
    sum_ = {};

    const bool in_vain =
        before_ > Duration{} && double(median.count()) > worthwhile * double(before_.count());
    before_ = {};
    if (in_vain) {
        coarsest_ = --step_;
    } else if (median > too_slow && step_ < coarsest_) {
        ++step_;
        before_ = median;
    } else if (median < fast_enough && step_ > 0) {
        --step_;
    }
}

void RenderScale::forget() {
    *this = {};
}

}  // namespace theatron::xr
