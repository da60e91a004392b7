// SPDX-License-Identifier: Apache-2.0
// Text and numbers within SVG.
#pragma once

#include <string>

namespace theatron::photon {

// The text inside an element. Control characters, which are no XML, become blanks.
std::string svg_escaped(const std::string& text);

// Appends as printf; at most 399 characters.
[[gnu::format(printf, 2, 3)]] void svg_add(std::string& svg, const char* format, ...);

}  // namespace theatron::photon
