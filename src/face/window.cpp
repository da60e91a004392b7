// SPDX-License-Identifier: Apache-2.0
#include "face/window.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::face {

Features features_of(std::span<const Sample> samples, const Channels& rest) {
    assert(!samples.empty());
    const float last = samples.back().time_s;
    Channels recent{}, mean{}, square{};
    float recent_count = 0, count = 0;
    for (std::size_t i = samples.size(); i-- > 0;) {
        const Sample& sample = samples[i];
        const float age = last - sample.time_s;
        if (age > window_s)
            break;
        count += 1;
        for (std::size_t c = 0; c < channel_count; ++c) {
            const float value = sample.values[c] - rest[c];
            mean[c] += value;
            square[c] += value * value;
        }
        if (age > recent_s)
            continue;
        recent_count += 1;
        for (std::size_t c = 0; c < channel_count; ++c)
            recent[c] += sample.values[c] - rest[c];
    }
    Features features{};
    for (std::size_t c = 0; c < channel_count; ++c) {
        const float m = mean[c] / count;
        features[c] = recent[c] / recent_count;
        features[channel_count + c] = m;
        features[2 * channel_count + c] = std::sqrt(std::max(0.F, square[c] / count - m * m));
    }
    return features;
}

Channels mean_of(std::span<const Sample> samples) {
    Channels mean{};
    for (const Sample& sample : samples)
        for (std::size_t c = 0; c < channel_count; ++c)
            mean[c] += sample.values[c] / float(samples.size());
    return mean;
}

bool fills_window(std::span<const Sample> samples) {
    return !samples.empty() && samples.back().time_s - samples.front().time_s >= 0.9F * window_s;
}

}  // namespace theatron::face
