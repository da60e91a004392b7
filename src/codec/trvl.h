// SPDX-License-Identifier: Apache-2.0
// RVL of the change since a reference frame, without loss.
//
// After H. Jun and J. Bailenson, "Temporal RVL: A Depth Stream Compression Method",
// IEEE VR 2020, but exact: there is no dead band, and differences wrap at 16 bits, so
// that all values are preserved. A key frame consists of plain RVL runs.
// docs/formats/depth_trvl.md specifies the bytes.
//
// All functions are pure: no allocation, no state. Safe to call from any thread with
// scratch memory of its own. `scratch` has one number per pixel.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::codec::trvl {

// Bytes that always suffice for an image of this size.
std::size_t max_encoded_size(Size size);

// Encodes `depth` into `out` of max_encoded_size bytes and returns the bytes used.
// `reference` has the same size; if it has no pixels, a key frame results.
std::size_t encode(DepthView depth, DepthView reference, std::span<std::uint16_t> scratch,
                   std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match the encoded image. `reference` is read
// by delta frames only; one without pixels or of another size counts as missing.
//
// Safe for untrusted input: never reads outside `encoded`, never writes outside
// `out` and `scratch`. On failure their content is unspecified.
Status decode(ByteView encoded, DepthView reference, std::span<std::uint16_t> scratch,
              MutableDepthView out);

}  // namespace theatron::codec::trvl
