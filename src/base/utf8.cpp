// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.h"

#include <cstdint>

namespace theatron {

Utf8Character first_character(std::string_view text) {
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
            return {0xfffd, i, false};
        // The second byte also excludes long spellings, surrogates and what lies beyond U+10FFFF.
        const std::uint8_t lowest = i > 1 ? 0x80 : lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
        const std::uint8_t highest = i > 1          ? 0xbf
                                     : lead == 0xed ? 0x9f
                                     : lead == 0xf4 ? 0x8f
                                                    : 0xbf;
        if (byte(i) < lowest || byte(i) > highest)
            return {0xfffd, i, false};
        code = code << 6 | (byte(i) & 0x3f);
    }
    return {code, length, true};
}

void drop_last_character(std::string& text) {
    const auto is_continued = [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
    };
    while (!text.empty() && is_continued(text.back()))
        text.pop_back();
    if (!text.empty())
        text.pop_back();
}

}  // namespace theatron
