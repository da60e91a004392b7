// SPDX-License-Identifier: Apache-2.0
// Pixels to baseline JPEG pictures (ITU-T T.81) with an encoder of our own, which
// is much faster than libjpeg-turbo and as faithful; see docs/decisions/jpeg.md.
// Native builds only.
#pragma once

#include <cstdint>
#include <memory>

#include "base/bytes.h"
#include "image/view.h"
#include "video/jpeg_encoder_kernel_native.h"

namespace theatron::video {

// Encodes pictures one after the other, with the standard Huffman tables. Not
// thread safe. Allocates only when the size of the pictures changes.
class JpegCompressor {
public:
    // `quality`: 1 to 100. `halve_chroma`: 4:2:0 rather than 4:4:4.
    JpegCompressor(int quality, bool halve_chroma);

    // The bytes of `image`, which is not empty. Valid until the next call.
    ByteView compress(ColorView image) &;

private:
    void prepare(Size size);

    int quality_;
    bool halve_chroma_;
    jpeg::ScanTables tables_;
    Size size_;  // for which the buffers are, and the header in them
    std::size_t header_size_ = 0;
    // Far larger than any real picture needs, and left untouched beyond that.
    std::unique_ptr<std::uint8_t[]> bytes_, row_buffer_;
};

}  // namespace theatron::video
