// SPDX-License-Identifier: Apache-2.0
#include "base/outside_text.h"

#include <cstdint>

namespace theatron {
namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // U+FFFD

struct Character {
    char32_t code = 0;
    std::size_t bytes = 1;  // how many of the text it takes, also if it is not valid
    bool valid = false;
};

// The first character of `text`, which is not empty. In an invalid sequence the longest part
// that could begin a character counts as one, as Unicode recommends.
Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return std::uint8_t(text[i]); };
    const std::uint8_t lead = byte(0);
    if (lead < 0x80)
        return {lead, 1, true};
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4)
        return {};
    char32_t code = lead & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if (i == text.size())
            return {0, i, false};
        // The second byte also excludes long spellings, surrogates and what lies beyond U+10FFFF.
        const std::uint8_t lowest = i > 1 ? 0x80 : lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
        const std::uint8_t highest = i > 1          ? 0xbf
                                     : lead == 0xed ? 0x9f
                                     : lead == 0xf4 ? 0x8f
                                                    : 0xbf;
        if (byte(i) < lowest || byte(i) > highest)
            return {0, i, false};
        code = code << 6 | (byte(i) & 0x3f);
    }
    return {code, length, true};
}

bool breaks_the_line(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c <= 0x9f) || c == 0x2028 || c == 0x2029;
}

// Marks, embeddings, overrides and isolates of the writing direction; the byte order mark.
bool is_left_out(char32_t c) {
    return c == 0x061c || c == 0x200e || c == 0x200f || (c >= 0x202a && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069) || c == 0xfeff;
}

}  // namespace

std::string clean_text(std::string_view text, std::size_t max_characters) {
    std::string clean;
    for (std::size_t characters = 0; !text.empty() && characters < max_characters;) {
        const Character c = first_character(text);
        const std::string_view bytes = text.substr(0, c.bytes);
        text.remove_prefix(c.bytes);
        if (c.valid && is_left_out(c.code))
            continue;
        clean += !c.valid ? replacement : breaks_the_line(c.code) ? std::string_view(" ") : bytes;
        ++characters;
    }
    return clean;
}

}  // namespace theatron
