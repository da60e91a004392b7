// SPDX-License-Identifier: Apache-2.0
// Letters without their accents.
#pragma once

#include <string_view>

namespace theatron {

// The small basic letter of a Latin one from U+00C0 to U+017F ("Ł" is "l", "ß" is "s", "æ" is
// "a"); blank for other characters.
constexpr char basic_letter(char32_t letter) {
    constexpr std::string_view basic_letters =
        "aaaaaaaceeeeiiiidnooooo ouuuuyts"
        "aaaaaaaceeeeiiiidnooooo ouuuuyty"
        "aaaaaaccccccccddddeeeeeeeeeegggg"
        "gggghhhhiiiiiiiiiiiijjkkklllllll"
        "lllnnnnnnnnnoooooooorrrrrrssssss"
        "ssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
    constexpr char32_t first = 0xc0;
    static_assert(basic_letters.size() == 0x180 - first);
    return letter >= first && letter < 0x180 ? basic_letters[letter - first] : ' ';
}

}  // namespace theatron
