// SPDX-License-Identifier: Apache-2.0
#include "registration/frame_mean.h"

#include <cassert>

namespace theatron::registration {

FrameMean::FrameMean(Size size) : size_(size), sums_(size.area()), counts_(size.area()) {}

void FrameMean::add(DepthView depth) {
    assert(depth.size == size_ && frames_ < 0xffff);
    ++frames_;
    for (int y = 0; y < size_.height; ++y) {
        const std::uint16_t* row = depth.row(y);
        const std::size_t first = std::size_t(y) * std::size_t(size_.width);
        for (std::size_t x = 0; x < std::size_t(size_.width); ++x) {
            sums_[first + x] += row[x];
            counts_[first + x] = std::uint16_t(counts_[first + x] + (row[x] != 0));
        }
    }
}

DepthImage FrameMean::mean() const {
    DepthImage image(size_);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (2 * counts_[i] <= frames_)
            continue;
        const std::uint64_t mean = (std::uint64_t(sums_[i]) * finer + counts_[i] / 2) / counts_[i];
        image.pixels[i] = mean <= 0xffff ? std::uint16_t(mean) : 0;
    }
    return image;
}

}  // namespace theatron::registration
