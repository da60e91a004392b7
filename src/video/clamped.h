// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace theatron::video {

// The nearest value of an 8-bit sample.
inline std::uint8_t clamped(int value) {
    return std::uint8_t(std::clamp(value, 0, 255));
}

}  // namespace theatron::video
