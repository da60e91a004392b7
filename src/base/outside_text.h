// SPDX-License-Identifier: Apache-2.0
// Text that comes from outside, made fit to be shown, logged and written to JSON.
//
// Names, reasons and problems are written by other people's programs. They may hold bytes that
// are no UTF-8, escape sequences for terminals, and characters that turn the order of what
// follows. Text passes through here once, where it comes in; everything behind relies on it.
#pragma once

#include <string>
#include <string_view>

namespace theatron {

// The first `max_characters` characters (code points) of `text` as valid UTF-8, on one line:
// each byte sequence that is no UTF-8 becomes U+FFFD, each control character (U+0000 to U+001F,
// U+007F to U+009F) and line separator becomes a space, and characters that change the writing
// direction are left out. Safe for any bytes; takes time and memory in proportion to `text`.
std::string clean_text(std::string_view text, std::size_t max_characters);

}  // namespace theatron
