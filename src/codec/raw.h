// SPDX-License-Identifier: Apache-2.0
// Depth as it is: two bytes a pixel, little-endian, row after row.
//
// The yardstick for ratios, and the fastest codec where a link has room. The
// bytes are specified in docs/formats/depth_raw.md.
//
// All functions are pure: no allocation, no state. Safe to call from any thread.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::codec::raw {

// Bytes of an encoded image of this size, always exactly as many.
std::size_t encoded_size(Size size);

// Encodes `depth` into `out`, which holds encoded_size bytes; returns them.
std::size_t encode(DepthView depth, std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match the encoded image. Safe for
// untrusted input.
Status decode(ByteView encoded, MutableDepthView out);

}  // namespace theatron::codec::raw
