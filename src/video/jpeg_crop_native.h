// SPDX-License-Identifier: Apache-2.0
// A part of a JPEG picture without decoding it, with libjpeg-turbo. Native builds only.
#pragma once

#include <memory>

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video {

// Crops pictures one after the other. Not thread safe.
class JpegCropper {
public:
    // The corner of a crop must be a multiple of this: the largest block that
    // cameras' pictures are made of.
    static constexpr int block = 16;

    JpegCropper();
    ~JpegCropper();

    // The part of `jpeg` at (x, y), multiples of `block`, of `size`, inside the
    // picture, with the same coefficients. Valid until the next call. Safe for
    // untrusted input. Unsupported if the picture has larger blocks.
    Result<ByteView> crop(ByteView jpeg, int x, int y, Size size) &;

private:
    struct Library;
    std::unique_ptr<Library> library_;
    Bytes bytes_;
};

}  // namespace theatron::video
