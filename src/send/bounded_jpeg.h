// SPDX-License-Identifier: Apache-2.0
// JPEG pictures of a camera within JpegBudget.
#pragma once

#include <memory>

#include "send/jpeg_budget.h"
#include "video/camera_pixels_native.h"
#include "video/jpeg_encoder_native.h"

namespace theatron::send {

// Not thread safe.
class BoundedJpeg {
public:
    explicit BoundedJpeg(const JpegLimits& limits) : budget_(limits) {}

    // The picture's bytes: a camera's own JPEG while that fits, otherwise encoded at the budget's
    // quality and size. Valid until the next call and no longer than `color`. Fails if a camera's
    // JPEG that must be recoded is damaged.
    Result<ByteView> encode(const ColorData& color);

private:
    ByteView encoded_at(const JpegBudget::Step& step, ColorView image);

    JpegBudget budget_;
    video::CameraPixels pixels_;
    ColorImage reduced_;
    int quality_ = 0;  // of the compressor
    std::unique_ptr<video::JpegCompressor> compressor_;
};

}  // namespace theatron::send
