// SPDX-License-Identifier: Apache-2.0
// A fast decoder for the JPEG pictures that cameras and our encoder write:
// sequential Huffman coding, three components, 4:2:0, 4:2:2 or 4:4:4.
// docs/decisions/jpeg.md gives the reasons for it.
#pragma once

#include <memory>

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"

namespace theatron::video {

// Decodes pictures one after the other. Not thread safe.
class BaselineJpegDecoder {
public:
    BaselineJpegDecoder();
    ~BaselineJpegDecoder();

    // Gives `out` the picture's size and pixels, keeping its memory; the pixels are
    // those of decode_jpeg_reference on every processor. Safe for untrusted input:
    // takes memory for a picture only if read_jpeg_size lets it pass. Unsupported:
    // other pictures than those above. Malformed: damaged or ending early. On failure
    // the content of `out` is unspecified.
    Status decode(ByteView jpeg, ColorImage& out);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace theatron::video
