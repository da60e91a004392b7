// SPDX-License-Identifier: Apache-2.0
// Coarser depth: levels that are several units wide. Validity is preserved.
//
// Value v > 0 becomes level (v - 1) / step + 1, and is restored to the middle of the
// level: at most step / 2 away. 0, no measurement, stays 0.
#pragma once

#include <algorithm>

#include "image/view.h"

namespace theatron::codec {

inline constexpr int max_quantisation_step = 100;

// `out` may be `depth`.
inline void quantise_rows(DepthView depth, int step, MutableDepthView out) {
    // Exact for 16 bits and steps up to 100: the distance of (v - 1 + 1/2) / step to a
    // whole number exceeds the rounding error. In this form compilers vectorise it.
    const float scale = 1.0f / float(step);
    for (int y = 0; y < depth.size.height; ++y) {
        const std::uint16_t* from = depth.row(y);
        std::uint16_t* to = out.row(y);
        for (int x = 0; x < depth.size.width; ++x) {
            const int level = int((float(from[x]) - 0.5f) * scale) + 1;
            to[x] = std::uint16_t(from[x] == 0 ? 0 : level);
        }
    }
}

// `out` may be `levels`. Accepts any level; those out of range become 65535.
inline void restore_rows(DepthView levels, int step, MutableDepthView out) {
    const int middle = (step + 1) / 2 - step;
    for (int y = 0; y < levels.size.height; ++y) {
        const std::uint16_t* from = levels.row(y);
        std::uint16_t* to = out.row(y);
        for (int x = 0; x < levels.size.width; ++x) {
            const int value = std::min(from[x] * step + middle, 0xffff);
            to[x] = std::uint16_t(from[x] == 0 ? 0 : value);
        }
    }
}

}  // namespace theatron::codec
