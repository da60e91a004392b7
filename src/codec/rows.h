// SPDX-License-Identifier: Apache-2.0
// Loops over the rows of depth images, shared by the codecs.
//
// Pixels are copied between images and bytes without conversion: all supported
// machines are little-endian, as the formats are.
#pragma once

#include <cstring>

#include "image/image.h"

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "The codecs copy pixels as little-endian bytes."
#endif

namespace theatron::codec {

inline void copy_rows(DepthView from, MutableDepthView to) {
    if (from.contiguous() && to.contiguous()) {
        std::memcpy(to.pixels, from.pixels, 2 * from.size.area());
        return;
    }
    for (int y = 0; y < from.size.height; ++y)
        std::memcpy(to.row(y), from.row(y), 2 * std::size_t(from.size.width));
}

// `out` = `a` - `b`, modulo 2^16. `out` may be `a`.
inline void subtract_rows(DepthView a, DepthView b, MutableDepthView out) {
    for (int y = 0; y < a.size.height; ++y) {
        const std::uint16_t* from = a.row(y);
        const std::uint16_t* minus = b.row(y);
        std::uint16_t* to = out.row(y);
        for (int x = 0; x < a.size.width; ++x)
            to[x] = std::uint16_t(from[x] - minus[x]);
    }
}

// `out` = `a` + `b`, modulo 2^16. `out` may be `a`.
inline void add_rows(DepthView a, DepthView b, MutableDepthView out) {
    for (int y = 0; y < a.size.height; ++y) {
        const std::uint16_t* from = a.row(y);
        const std::uint16_t* plus = b.row(y);
        std::uint16_t* to = out.row(y);
        for (int x = 0; x < a.size.width; ++x)
            to[x] = std::uint16_t(from[x] + plus[x]);
    }
}

// Maps small differences of either sign to small numbers: 0, -1, 1, -2, ... become
// 0, 1, 2, 3, ...
constexpr std::uint16_t zigzag(std::uint16_t difference) {
    return std::uint16_t((difference << 1) ^ (difference & 0x8000 ? 0xffff : 0));
}
constexpr std::uint16_t unzigzag(std::uint16_t code) {
    return std::uint16_t((code >> 1) ^ (code & 1 ? 0xffff : 0));
}
static_assert(unzigzag(zigzag(0x8000)) == 0x8000 && zigzag(0xffff) == 1);

}  // namespace theatron::codec
