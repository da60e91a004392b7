// SPDX-License-Identifier: Apache-2.0
#include "base/outside_text.h"

#include "base/utf8.h"

namespace theatron {
namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // U+FFFD

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
        const Utf8Character c = first_character(text);
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
