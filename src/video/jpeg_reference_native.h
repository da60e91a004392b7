// SPDX-License-Identifier: Apache-2.0
// A JPEG decoder in the plainest form: bit by bit, block by block, pixel by pixel.
// It defines the pixels and the refusals of the fast one (jpeg_decoder.h).
// Native builds only.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"

namespace theatron::video {

// As BaselineJpegDecoder::decode.
Status decode_jpeg_reference(ByteView jpeg, ColorImage& out);

}  // namespace theatron::video
