// SPDX-License-Identifier: Apache-2.0
// Small letters of ASCII text in any locale. All other bytes stay, those of UTF-8 too.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace theatron {

constexpr char small_letter(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

inline std::string in_small_letters(std::string_view text) {
    std::string small(text);
    std::transform(small.begin(), small.end(), small.begin(), small_letter);
    return small;
}

// True where the texts differ in capital letters alone, or not at all.
inline bool equal_without_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return small_letter(x) == small_letter(y); });
}

}  // namespace theatron
