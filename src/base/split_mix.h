// SPDX-License-Identifier: Apache-2.0
// Numbers from a seed that are the same on every machine: SplitMix64 (Steele, Lea and Flood 2014).
// For generated content and orders, not for secrets.
#pragma once

#include <cstdint>

namespace theatron {

inline std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
    // From 0 to count - 1, each equally likely; `count` is above 0.
    std::uint64_t below(std::uint64_t count) {
        const std::uint64_t whole = ~std::uint64_t(0) - ~std::uint64_t(0) % count;
        std::uint64_t value = next();
        while (value >= whole)
            value = next();
        return value % count;
    }

private:
    std::uint64_t state_;
};

}  // namespace theatron
