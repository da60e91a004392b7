// SPDX-License-Identifier: Apache-2.0
// Characters of UTF-8. Pure; safe for any bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace theatron {

struct Utf8Character {
    char32_t code = 0xfffd;
    std::size_t bytes = 1;  // how many of the text it takes, also if it is not valid
    bool valid = false;
};

// The first character of `text`, which is not empty. In an invalid sequence the longest part that
// could begin a character counts as one, as Unicode recommends; its code is U+FFFD.
Utf8Character first_character(std::string_view text);

// With all of its bytes; a text without any stays empty.
void drop_last_character(std::string& text);

}  // namespace theatron
