// SPDX-License-Identifier: Apache-2.0
// The bytes of a picture of a case (docs/formats/case_picture.md): a photograph, a scan of a sheet,
// a screenshot. It has no place in the patient.
//
// Pure functions.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/image.h"

namespace theatron::medical {

// Every device that draws with OpenGL ES 3 takes a texture of this size.
inline constexpr int max_picture_side = 2048;

// True for 1 to max_picture_side pixels on both sides.
bool is_picture_size(Size size);

// `picture` must have such a size. A picture in greys takes a third of the bytes.
Bytes encode_picture(ColorView picture);

// Safe for any bytes: takes no more memory than three times `bytes`.
Result<ColorImage> decode_picture(ByteView bytes);

// A picture of any size with its longer side shortened to `max_side` by averaging areas; the
// same picture if it is not longer.
ColorImage reduced(ColorImage picture, int max_side);

}  // namespace theatron::medical
