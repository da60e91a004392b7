// SPDX-License-Identifier: Apache-2.0
// Depth as two planes of bytes with small values, for general-purpose compressors.
//
// Each pixel becomes its zigzagged difference to a prediction. All low bytes come
// first, then all high bytes; the latter are mostly zero and compress to almost
// nothing. The prediction is the same pixel of the reference frame or, without one,
// the pixel to the left (the one above for the first of a row).
//
// All functions are pure: no allocation, no state.
#pragma once

#include <span>

#include "base/bytes.h"
#include "image/view.h"

namespace theatron::codec {

// Writes the 2 * area bytes of `depth`. `reference` has the same size or no pixels.
void split_planes(DepthView depth, DepthView reference, std::span<std::byte> planes);

// The inverse: converts 2 * area bytes, of any content, to the depth in `out`.
void join_planes(ByteView planes, DepthView reference, MutableDepthView out);

}  // namespace theatron::codec
