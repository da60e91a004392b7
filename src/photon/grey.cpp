// SPDX-License-Identifier: Apache-2.0
#include "photon/grey.h"

#include <cassert>

namespace theatron::photon {

void grey_of(ColorView color, GreyImage& out) {
    out.resize(color.size);
    const View<std::uint8_t> grey = out.view();
    for (int y = 0; y < color.size.height; ++y) {
        const Rgb* const from = color.row(y);
        std::uint8_t* const to = grey.row(y);
        for (int x = 0; x < color.size.width; ++x)
            to[x] = std::uint8_t((77 * from[x].r + 150 * from[x].g + 29 * from[x].b + 128) >> 8);
    }
}

void halve(GreyView in, GreyImage& out) {
    assert(in.size.width >= 2 && in.size.height >= 2);
    out.resize({in.size.width / 2, in.size.height / 2});
    const View<std::uint8_t> half = out.view();
    for (int y = 0; y < half.size.height; ++y) {
        const std::uint8_t* const upper = in.row(2 * y);
        const std::uint8_t* const lower = in.row(2 * y + 1);
        for (int x = 0; x < half.size.width; ++x)
            half.row(y)[x] = std::uint8_t(
                (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) / 4);
    }
}

}  // namespace theatron::photon
