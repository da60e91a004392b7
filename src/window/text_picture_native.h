// SPDX-License-Identifier: Apache-2.0
// A line of text as a plain picture, for where nothing else draws letters. Pure.
#pragma once

#include <string_view>

#include "image/image.h"
#include "render/font_atlas.h"

namespace theatron::window {

// The width of the line in pixels, where a capital letter is so high.
double text_width(const render::FontAtlas& font, std::string_view utf8, double capital_pixels);

// The line in `ink` on `ground`, with a margin of one capital letter on each side.
ColorImage text_picture(const render::FontAtlas& font, std::string_view utf8, double capital_pixels,
                        Rgb ink, Rgb ground);

}  // namespace theatron::window
