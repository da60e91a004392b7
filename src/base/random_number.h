// SPDX-License-Identifier: Apache-2.0
// A number by which something is told apart from all others, wherever they are made. Not a secret.
#pragma once

#include <cstdint>
#include <random>

namespace theatron {

// 63 random bits; never 0.
inline std::uint64_t random_number() {
    std::random_device random;
    return (std::uint64_t(random()) << 32 | random()) | 1;
}

}  // namespace theatron
