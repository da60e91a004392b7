// SPDX-License-Identifier: Apache-2.0
#include "cases/series_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace theatron::cases {
namespace {

// The intercept of an image as it was read, whose samples may be lowered.
double intercept_of(const DicomSlice& slice) {
    return slice.intercept + (slice.lowered ? 32'768 * slice.slope : 0);
}

std::int16_t sample_of(double value) {
    return std::int16_t(std::clamp(std::lround(value), -32'768l, 32'767l));
}

}  // namespace

ValueScale common_scale(const std::vector<DicomSlice>& slices) {
    const DicomSlice& first = slices.front();
    ValueScale scale{first.slope, first.intercept};
    bool has_one_intercept = true;
    for (const DicomSlice& slice : slices) {
        scale.is_common =
            scale.is_common && slice.slope == first.slope && slice.intercept == first.intercept;
        has_one_intercept = has_one_intercept && slice.intercept == first.intercept;
        scale.lowered = scale.lowered || slice.lowered;
        if (std::abs(slice.slope) > std::abs(scale.slope))
            scale.slope = slice.slope;
    }
    if (scale.is_common) {
        scale.slope = first.slope;
        scale.intercept = first.intercept + (scale.lowered ? 32'768 * first.slope : 0);
        return scale;
    }
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const DicomSlice& slice : slices)
        for (const std::int16_t sample : slice.samples) {
            const double value = slice.slope * sample + intercept_of(slice);
            low = std::min(low, value);
            high = std::max(high, value);
        }
    scale.slope = std::abs(scale.slope);
    const auto fits = [&](double intercept) {
        return (low - intercept) / scale.slope >= -32'768.5 &&
               (high - intercept) / scale.slope <= 32'767.5;
    };
    scale.intercept = first.intercept;
    if (has_one_intercept && fits(scale.intercept))
        return scale;
    scale.slope = std::max(scale.slope, (high - low) / 65'535);
    scale.intercept = low + 32'768 * scale.slope;
    return scale;
}

std::int16_t SampleCounts::at_share(double share) const {
    const auto sum = [](const std::vector<std::uint64_t>& counts) {
        std::uint64_t all = 0;
        for (const std::uint64_t count : counts)
            all += count;
        return all;
    };
    const std::vector<std::uint64_t>& counts = sum(counts_) > 0 ? counts_ : all_counts_;
    const double wanted = share * double(sum(counts));
    double passed = 0;
    for (int i = 0; i < 65'536; ++i) {
        passed += double(counts[std::size_t(i)]);
        if (passed > wanted || (passed >= wanted && wanted > 0))
            return std::int16_t(i - 32'768);
    }
    return 32'767;
}

std::int16_t SampleCounts::lowest() const {
    const auto found = std::find_if(all_counts_.begin(), all_counts_.end(),
                                    [](std::uint64_t count) { return count > 0; });
    return std::int16_t(found - all_counts_.begin() - 32'768);
}

void bring_to_scale(DicomSlice& slice, const ValueScale& scale, SampleCounts& counts) {
    const bool is_lowered_now = scale.is_common && scale.lowered && !slice.lowered;
    const double offset = (intercept_of(slice) - scale.intercept) / scale.slope;
    const double factor = slice.slope / scale.slope;
    for (std::int16_t& sample : slice.samples) {
        const bool is_padding =
            slice.has_padding && sample >= slice.padding_low && sample <= slice.padding_high;
        if (is_lowered_now)
            sample = std::int16_t(sample - 32'768);
        else if (!scale.is_common)
            sample = sample_of(factor * sample + offset);
        counts.add(sample, is_padding);
    }
}

medical::Window window_of(const std::vector<DicomSlice>& slices, const SampleCounts& counts,
                          const ValueScale& scale) {
    for (const DicomSlice& slice : slices)
        if (slice.has_window)
            return slice.window;
    const double a = scale.slope * counts.at_share(0.005) + scale.intercept;
    const double b = scale.slope * counts.at_share(0.995) + scale.intercept;
    return {(a + b) / 2, std::max(std::abs(b - a), std::abs(scale.slope))};
}

}  // namespace theatron::cases
