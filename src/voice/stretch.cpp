// SPDX-License-Identifier: Apache-2.0
#include "voice/stretch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::voice {
namespace {

// Mean power of 20 bits below full scale: no period can be heard in it.
constexpr double silence_power = 1e-8;
// The first search skips samples: voice has little above 6 kHz that decides a period.
constexpr std::size_t coarse_step = 4;

double similarity(std::span<const float> block, std::size_t lag, std::size_t step) {
    double product = 0, a2 = 0, b2 = 0;
    for (std::size_t i = 0; i < lag; i += step) {
        const double a = double(block[i]), b = double(block[i + lag]);
        product += a * b;
        a2 += a * a;
        b2 += b * b;
    }
    if (a2 + b2 < silence_power * 2 * double(lag) / double(step))
        return 1;
    return product / std::sqrt(std::max(a2 * b2, 1e-30));
}

// From a to b over their length.
float faded(float a, float b, std::size_t i, std::size_t count) {
    const float share = (float(i) + 0.5f) / float(count);
    return a + (b - a) * share;
}

}  // namespace

Period find_period(std::span<const float> block) {
    const std::size_t longest = std::min(max_period, block.size() / 2);
    Period best{0, -2};
    for (std::size_t lag = min_period; lag <= longest; lag += coarse_step)
        if (const double s = similarity(block, lag, coarse_step); s > best.similarity)
            best = {lag, s};
    if (best.samples == 0)
        return {};
    const std::size_t from = std::max(min_period, best.samples - coarse_step + 1);
    const std::size_t to = std::min(longest, best.samples + coarse_step - 1);
    best.similarity = -2;
    for (std::size_t lag = from; lag <= to; ++lag)
        if (const double s = similarity(block, lag, 1); s > best.similarity)
            best = {lag, s};
    return best;
}

void leave_out(std::vector<float>& block, std::size_t period) {
    assert(2 * period <= block.size());
    for (std::size_t i = 0; i < period; ++i)
        block[i + period] = faded(block[i], block[i + period], i, period);
    block.erase(block.begin(), block.begin() + std::ptrdiff_t(period));
}

void repeat(std::vector<float>& block, std::size_t period) {
    assert(2 * period <= block.size());
    std::vector<float> inserted(period);
    for (std::size_t i = 0; i < period; ++i)
        inserted[i] = faded(block[i + period], block[i], i, period);
    block.insert(block.begin() + std::ptrdiff_t(period), inserted.begin(), inserted.end());
}

}  // namespace theatron::voice
