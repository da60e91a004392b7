// SPDX-License-Identifier: Apache-2.0
// The mean of the depth images of a still scene.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace theatron::registration {

class FrameMean {
public:
    // Steps of the mean for one step of the images.
    static constexpr int finer = 10;

    explicit FrameMean(Size size);

    // `depth` must have the size given to the constructor.
    void add(DepthView depth);
    int frames() const { return frames_; }

    // Pixels measured in most of the frames; the others are 0. Values are in tenths of the images'
    // unit; those beyond 16 bits are 0.
    DepthImage mean() const;

private:
    Size size_;
    int frames_ = 0;
    std::vector<std::uint32_t> sums_;
    std::vector<std::uint16_t> counts_;
};

}  // namespace theatron::registration
