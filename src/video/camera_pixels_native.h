// SPDX-License-Identifier: Apache-2.0
// The pixels of a camera's picture, which may come as JPEG.
#pragma once

#include <utility>

#include "image/frame.h"
#include "video/jpeg_native.h"

namespace theatron::video {

class CameraPixels {
public:
    // Valid until the next call and no longer than `color`. Fails if the
    // camera's JPEG is damaged.
    Result<ColorView> of(const ColorData& color) {
        if (!color.is_jpeg())
            return color.pixels.view();
        if (const Status s = decompressor_.decompress(color.jpeg, image_); s != Status::ok)
            return s;
        return std::as_const(image_).view();
    }

private:
    JpegDecompressor decompressor_;
    ColorImage image_;
};

}  // namespace theatron::video
