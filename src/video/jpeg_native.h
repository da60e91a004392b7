// SPDX-License-Identifier: Apache-2.0
// JPEG pictures to pixels. Native builds only.
#pragma once

#include <memory>

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"
#include "video/jpeg_decoder.h"

namespace theatron::video {

// Decodes pictures one after the other: with our own decoder those that it takes,
// with libjpeg-turbo grey ones and others that few cameras give. Not thread safe.
// Prints nothing.
class JpegDecompressor {
public:
    JpegDecompressor();
    ~JpegDecompressor();

    // Gives `out` the picture's size and pixels, keeping its memory. Safe for
    // untrusted input; see read_jpeg_size for what is refused. A picture whose
    // data ends early or is damaged is refused as well. On failure the content
    // of `out` is unspecified.
    Status decompress(ByteView jpeg, ColorImage& out);

private:
    struct Library;
    BaselineJpegDecoder own_;
    std::unique_ptr<Library> library_;
};

}  // namespace theatron::video
