// SPDX-License-Identifier: Apache-2.0
#include "voice/device_pace.h"

#include <algorithm>
#include <cmath>

#include "voice/packet.h"

namespace theatron::voice {
namespace {

constexpr double slowest_clock = 1.0 / 500;

double us_of(std::size_t samples) {
    return double(samples) * 1e6 / sample_rate;
}

}  // namespace

void DevicePace::note(std::size_t samples, TimePoint at) {
    const double length_us = us_of(samples), at_us = double(to_us(at));
    const bool begins = !is_known() || at_us > next_us_ + double(longest_silence.count());
    const double called_us = begins ? at_us : std::min(at_us, next_us_ + length_us * slowest_clock);
    next_us_ = called_us + length_us;
    blocks_[oldest_] = samples;
    oldest_ = (oldest_ + 1) % blocks_.size();
    block_ = *std::max_element(blocks_.begin(), blocks_.end());
}

std::size_t DevicePace::asked_until(TimePoint time) const {
    if (!is_known())
        return 0;
    // Rounding must not tell another time than time_of().
    const double blocks = (double(to_us(time)) - next_us_) / us_of(block_) - 1;
    std::size_t asked = std::size_t(std::max(0.0, blocks)) * block_;
    while (time_of(asked) <= time)
        asked += block_;
    return asked;
}

TimePoint DevicePace::time_of(std::size_t sample) const {
    const double blocks = double(sample / block_);
    return from_us(std::int64_t(std::ceil(next_us_ + blocks * us_of(block_))));
}

}  // namespace theatron::voice
