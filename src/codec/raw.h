// SPDX-License-Identifier: Apache-2.0
// Uncompressed depth: two bytes a pixel, little-endian, row after row.
//
// The baseline for compression ratios, and the fastest codec where bandwidth allows.
// docs/formats/depth_raw.md specifies the bytes.
//
// All functions are pure: no allocation, no state. Safe to call from any thread.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::codec::raw {

// The exact number of bytes of an encoded image of this size.
std::size_t encoded_size(Size size);

// Encodes `depth` into `out` of encoded_size bytes; returns that number.
std::size_t encode(DepthView depth, std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match the encoded image. Safe for
// untrusted input.
Status decode(ByteView encoded, MutableDepthView out);

}  // namespace theatron::codec::raw
