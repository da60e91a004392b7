// SPDX-License-Identifier: Apache-2.0
// Four 16-bit numbers in one 64-bit register, in portable C++.
#pragma once

#include <cstdint>
#include <cstring>

namespace theatron::codec {

// Lane 0 has the lowest bits and is first in memory.
using Lanes = std::uint64_t;

inline constexpr Lanes every_lane = 0x0001'0001'0001'0001;
inline constexpr Lanes every_top_bit = 0x8000'8000'8000'8000;

inline Lanes load_lanes(const void* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}
inline void store_lanes(void* to, Lanes lanes) {
    std::memcpy(to, &lanes, sizeof(lanes));
}

constexpr std::uint16_t lane(Lanes lanes, unsigned i) {
    return std::uint16_t(lanes >> (16 * i));
}

// A mask of the first `count` lanes, 1 to 4.
constexpr Lanes lowest_lanes(unsigned count) {
    return ~Lanes(0) >> (64 - 16 * count);
}

constexpr Lanes add_lanes(Lanes a, Lanes b) {
    return ((a & ~every_top_bit) + (b & ~every_top_bit)) ^ ((a ^ b) & every_top_bit);
}
constexpr Lanes subtract_lanes(Lanes a, Lanes b) {
    return ((a | every_top_bit) - (b & ~every_top_bit)) ^ ((a ^ ~b) & every_top_bit);
}

// zigzag of every lane.
constexpr Lanes zigzag_lanes(Lanes differences) {
    const Lanes negative = (differences >> 15) & every_lane;
    return ((differences & ~every_top_bit) << 1) ^ ((negative << 16) - negative);
}

// Sets the top bit of the lowest zero lane; the bits above it are unspecified. Zero if
// no lane is zero.
constexpr Lanes lowest_zero_lane(Lanes lanes) {
    return (lanes - every_lane) & ~lanes & every_top_bit;
}

static_assert(add_lanes(0xffff'0001'7fff'8000, 0x0001'0001'0001'8000) == 0x0000'0002'8000'0000);
static_assert(subtract_lanes(0x0000'0001'8000'0005, 0x0001'0001'0001'0006) ==
              0xffff'0000'7fff'ffff);
static_assert(zigzag_lanes(Lanes{0x8000'ffff'0001'0000}) == 0xffff'0001'0002'0000);

}  // namespace theatron::codec
