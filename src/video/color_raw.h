// SPDX-License-Identifier: Apache-2.0
// Uncompressed colour (docs/formats/color_raw.md): a header of six bytes, then
// the pixels. Pure functions, no allocation.
#pragma once

#include <span>

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video::color_raw {

std::size_t encoded_size(Size size);

// Writes encoded_size(image.size) bytes to `out`, which holds at least as many.
// The size is valid (image/view.h).
void encode(ColorView image, std::span<std::byte> out);

// The size of an encoded image that is complete. Safe for untrusted input.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match. Safe for untrusted input.
Status decode(ByteView encoded, MutableColorView out);

}  // namespace theatron::video::color_raw
