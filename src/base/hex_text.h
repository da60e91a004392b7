// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

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

// Nothing unless the text is exactly that.
inline std::optional<Bytes> bytes_of_hex(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    if (text.size() % 2 != 0)
        return std::nullopt;
    Bytes bytes;
    for (std::size_t i = 0; i < text.size(); i += 2) {
        const auto high = digits.find(text[i]), low = digits.find(text[i + 1]);
        if (high == digits.npos || low == digits.npos)
            return std::nullopt;
        bytes.push_back(std::byte(16 * high + low));
    }
    return bytes;
}

}  // namespace theatron
