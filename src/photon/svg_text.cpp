// SPDX-License-Identifier: Apache-2.0
#include "photon/svg_text.h"

#include <cstdarg>
#include <cstdint>
#include <cstdio>

namespace theatron::photon {

std::string svg_escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        switch (c) {
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            default:
                // Control characters are no XML.
                out += std::uint8_t(c) < 0x20 ? ' ' : c;
        }
    return out;
}

void svg_add(std::string& svg, const char* format, ...) {
    char text[400];
    va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    svg += text;
}

}  // namespace theatron::photon
