// SPDX-License-Identifier: Apache-2.0
// The values of a series: one scale for all its images, and a window that shows them. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/dicom_slice.h"
#include "medical/volume.h"

namespace theatron::cases {

struct ValueScale {
    double slope = 1, intercept = 0;
    bool is_common = true;  // all images have it: samples are kept as they are
    bool lowered = false;   // then all samples are, where one image's are
};

// The scale of all images. Where they have scales of their own, as in PET: the coarsest one, or one
// that holds all values.
ValueScale common_scale(const std::vector<DicomSlice>& slices);

// How often each sample occurs, without those that hold nothing (padding).
class SampleCounts {
public:
    SampleCounts() : counts_(65'536), all_counts_(65'536) {}
    void add(std::int16_t sample, bool is_padding) {
        ++all_counts_[std::size_t(sample + 32'768)];
        if (!is_padding)
            ++counts_[std::size_t(sample + 32'768)];
    }
    // The sample below which this share of all lie; of padding, too, if there is nothing else.
    std::int16_t at_share(double share) const;
    std::int16_t lowest() const;

private:
    std::vector<std::uint64_t> counts_, all_counts_;
};

// Brings the samples of an image to the scale, and counts them.
void bring_to_scale(DicomSlice& slice, const ValueScale& scale, SampleCounts& counts);

// The first window that an image gives; otherwise one of the middle 99 % of all values.
medical::Window window_of(const std::vector<DicomSlice>& slices, const SampleCounts& counts,
                          const ValueScale& scale);

}  // namespace theatron::cases
