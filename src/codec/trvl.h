// SPDX-License-Identifier: Apache-2.0
// RVL over the change since a reference frame, without loss.
//
// After H. Jun and J. Bailenson, "Temporal RVL: A Depth Stream Compression
// Method", IEEE VR 2020, but for exact depth: no dead band, and differences wrap
// at 16 bits, so that any value survives. A key frame holds plain RVL runs. The
// bytes are specified in docs/formats/depth_trvl.md.
//
// All functions are pure: no allocation, no state. Safe to call from any thread
// with a scratch memory of its own. `scratch` holds one number for each pixel.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::codec::trvl {

// Bytes that always suffice for an image of this size.
std::size_t max_encoded_size(Size size);

// Encodes `depth` into `out` of max_encoded_size bytes and returns the bytes
// used. `reference` has the same size; without pixels it makes a key frame.
std::size_t encode(DepthView depth, DepthView reference, std::span<std::uint16_t> scratch,
                   std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match the encoded image. `reference` is
// only looked at by frames that need it; without pixels, or of another size, it
// counts as missing.
//
// Safe for untrusted input: never reads outside `encoded`, never writes outside
// `out` and `scratch`. On failure their content is unspecified.
Status decode(ByteView encoded, DepthView reference, std::span<std::uint16_t> scratch,
              MutableDepthView out);

}  // namespace theatron::codec::trvl
