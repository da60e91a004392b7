// SPDX-License-Identifier: Apache-2.0
// Planes of 8-bit samples with half the colour on each side, in the colour space of JPEG, to RGB:
// bit by bit as libjpeg-turbo, which the native build uses. Portable; a pure function.
#pragma once

#include <cstdint>

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video {

// Where the samples lie in a buffer. Planes may be interleaved: `chroma_step` is the distance of
// two samples in a row of `u` and of `v`.
struct PlaneLayout {
    std::size_t y = 0, u = 0, v = 0;  // first bytes
    std::size_t y_stride = 0, chroma_stride = 0, chroma_step = 1;
};

// Chroma has half the sides of `out`, rounded up. Fails (truncated) if the planes do not lie within
// `samples`, and then writes nothing.
Status pixels_of_planes(ByteView samples, const PlaneLayout& layout, MutableColorView out);

// The same of pixels that have four bytes each, of which the last is passed over.
Status pixels_of_quads(ByteView samples, std::size_t first, std::size_t stride,
                       MutableColorView out);

}  // namespace theatron::video
