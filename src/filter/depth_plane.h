// SPDX-License-Identifier: Apache-2.0
// Depth between two filters, with a margin of "no measurement" around it, so that
// kernels read neighbours and whole vectors without asking where the image ends.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "image/view.h"

namespace theatron::filter {

// Rows -1 to height may be read, and of each row the pixels -margin to
// padded_width + margin. All outside the image stays 0.
class DepthPlane {
public:
    static constexpr int margin = 32;  // the longest vector of 16-bit lanes

    static int padded_width_of(Size size) { return (size.width + margin - 1) / margin * margin; }
    // Whole words of a bit per pixel: those of HoleScratch have the same shape.
    static std::ptrdiff_t pitch_of(Size size) {
        return (padded_width_of(size) + 2 * margin + 63) / 64 * 64;
    }

    explicit DepthPlane(Size size)
        : size_(size),
          padded_width_(padded_width_of(size)),
          pitch_(pitch_of(size)),
          vectors_(std::size_t(pitch_) * std::size_t(size.height + 2) / margin) {}

    Size size() const { return size_; }
    int padded_width() const { return padded_width_; }
    std::ptrdiff_t pitch() const { return pitch_; }

    std::uint16_t* row(int y) { return vectors_.front().pixels + (y + 1) * pitch_ + margin; }
    const std::uint16_t* row(int y) const {
        return vectors_.front().pixels + (y + 1) * pitch_ + margin;
    }

    MutableDepthView view() { return {row(0), size_, pitch_}; }
    DepthView view() const { return {row(0), size_, pitch_}; }

    void clear() { std::fill(vectors_.begin(), vectors_.end(), Vector{}); }

private:
    // Rows begin where a vector begins: one that lies across two cache lines costs two.
    struct alignas(2 * margin) Vector {
        std::uint16_t pixels[margin] = {};
    };

    Size size_;
    int padded_width_;
    std::ptrdiff_t pitch_;
    std::vector<Vector> vectors_;
};

}  // namespace theatron::filter
