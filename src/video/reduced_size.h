// SPDX-License-Identifier: Apache-2.0
// The sizes that a camera's colour may have in automatic colour: a sender whose JPEG pictures take
// too many bytes halves them, or halves them twice.
#pragma once

#include <algorithm>
#include <iterator>

#include "image/view.h"

namespace theatron::video {

inline constexpr int color_divisors[] = {1, 2, 4};

// The size of a picture of which each `divisor` x `divisor` pixels became one; what is left over at
// the right and at the bottom is cut off.
constexpr Size reduced(Size whole, int divisor) {
    return {std::max(whole.width / divisor, 1), std::max(whole.height / divisor, 1)};
}

constexpr bool is_reduced(Size picture, Size whole) {
    return std::any_of(std::begin(color_divisors), std::end(color_divisors),
                       [&](int divisor) { return picture == reduced(whole, divisor); });
}

}  // namespace theatron::video
