// SPDX-License-Identifier: Apache-2.0
// Letters without their accents and capitals.
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

// A Greek or Cyrillic letter as a small one without accent ("Ώ" is "ω", "ς" is "σ", "Ё" is "е", but
// "Й" is "й"); the same for other characters.
constexpr char32_t small_basic_letter(char32_t letter) {
    struct Pair {
        char32_t letter, small;
    };
    constexpr Pair others[] = {{0x386, 0x3b1}, {0x388, 0x3b5}, {0x389, 0x3b7}, {0x38a, 0x3b9},
                               {0x38c, 0x3bf}, {0x38e, 0x3c5}, {0x38f, 0x3c9}, {0x390, 0x3b9},
                               {0x3aa, 0x3b9}, {0x3ab, 0x3c5}, {0x3ac, 0x3b1}, {0x3ad, 0x3b5},
                               {0x3ae, 0x3b7}, {0x3af, 0x3b9}, {0x3b0, 0x3c5}, {0x3c2, 0x3c3},
                               {0x3ca, 0x3b9}, {0x3cb, 0x3c5}, {0x3cc, 0x3bf}, {0x3cd, 0x3c5},
                               {0x3ce, 0x3c9}, {0x401, 0x435}, {0x451, 0x435}, {0x4ba, 0x4bb},
                               {0x500, 0x501}, {0x51a, 0x51b}, {0x51c, 0x51d}};
    for (const Pair& other : others)
        if (other.letter == letter)
            return other.small;
    if ((letter >= 0x391 && letter < 0x3aa) || (letter >= 0x410 && letter < 0x430))
        return letter + 0x20;
    return letter >= 0x400 && letter < 0x410 ? letter + 0x50 : letter;
}

}  // namespace theatron
