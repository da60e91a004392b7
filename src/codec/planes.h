// SPDX-License-Identifier: Apache-2.0
// Depth as two planes of small bytes, for general compressors.
//
// Each pixel becomes its difference to a prediction, zigzagged; all low bytes
// come first, then all high bytes, so that the mostly zero high bytes cost next
// to nothing. The prediction is the same pixel of a reference frame or, without
// one, the pixel to the left (the one above for the first of a row).
//
// All functions are pure: no allocation, no state.
#pragma once

#include <span>

#include "base/bytes.h"
#include "image/view.h"

namespace theatron::codec {

// Writes the 2 * area bytes of `depth`. `reference` has the same size or no pixels.
void split_planes(DepthView depth, DepthView reference, std::span<std::byte> planes);

// The reverse: 2 * area bytes, any of them, to the depth in `out`.
void join_planes(ByteView planes, DepthView reference, MutableDepthView out);

}  // namespace theatron::codec
