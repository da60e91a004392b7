// SPDX-License-Identifier: Apache-2.0
// Lossless coding of a depth image's mask of valid pixels: one adaptive binary
// decision per pixel, with its neighbours and the previous frame as context.
// The bytes are specified in docs/formats/depth_h264.md. Pure functions.
#pragma once

#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video::depth_mask {

// One byte a pixel, 0 or 1, with a border of zeros: two pixels left and right,
// two rows above, one below, so that contexts need no limits.
class Mask {
public:
    void resize(Size size);  // all 0
    void set_from(DepthView depth);

    Size size() const { return size_; }
    std::uint8_t* row(int y) { return pixels_.data() + offset(y); }
    const std::uint8_t* row(int y) const { return pixels_.data() + offset(y); }
    std::ptrdiff_t stride() const { return size_.width + 4; }

private:
    std::size_t offset(int y) const { return std::size_t((y + 2) * stride() + 2); }
    Size size_;
    std::vector<std::uint8_t> pixels_;
};

// Bytes that always suffice.
std::size_t max_encoded_size(Size size);

// Encodes `mask` into `out`; returns the bytes used. `before` has the same size;
// all 0 at key frames.
std::size_t encode(const Mask& mask, const Mask& before, std::span<std::byte> out);

// Decodes into `mask`, which has its size. Safe for untrusted input.
Status decode(ByteView encoded, const Mask& before, Mask& mask);

}  // namespace theatron::video::depth_mask
