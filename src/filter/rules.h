// SPDX-License-Identifier: Apache-2.0
// Integer arithmetic shared by all variants of a filter: the plain reference, the borders of
// the SIMD loops, and CUDA.
#pragma once

#include <cstdint>

#if defined(__CUDACC__)
#define THEATRON_HD __host__ __device__
#else
#define THEATRON_HD
#endif

namespace theatron::filter {

inline constexpr int none = 0;  // no measurement

THEATRON_HD inline int smaller(int a, int b) {
    return a < b ? a : b;
}
THEATRON_HD inline int larger(int a, int b) {
    return a < b ? b : a;
}
THEATRON_HD inline int clamped(int v, int low, int high) {
    return v < low ? low : v > high ? high : v;
}
THEATRON_HD inline int distance(int a, int b) {
    return a < b ? b - a : a - b;
}

// A length that grows with the distance: constant + slope / 65536 * distance.
struct Tolerance {
    std::uint16_t constant = 0;
    std::uint16_t slope = 0;
};

THEATRON_HD inline int tolerance_at(Tolerance t, int depth) {
    const int sum = t.constant + int((std::uint32_t(depth) * t.slope) >> 16);
    return sum < 0xffff ? sum : 0xffff;
}

}  // namespace theatron::filter
