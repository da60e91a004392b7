// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/bytes.h"

namespace theatron {

// Two lower-case digits for each byte.
inline std::string hex_text(ByteView bytes) {
    std::string text;
    for (const std::byte b : bytes)
        for (const int shift : {4, 0})
            text += "0123456789abcdef"[std::to_integer<int>(b) >> shift & 15];
    return text;
}

}  // namespace theatron
