// SPDX-License-Identifier: Apache-2.0
#include "window/imgui_fonts_native.h"

#include <algorithm>
#include <cmath>

#include "window/font.h"

namespace theatron::window {
namespace {

// In place of letters that the fonts lack.
constexpr ImWchar hollow_box = 0x25a1;
// Latin (also of Vietnamese), Greek, Cyrillic, Armenian and Georgian letters, and the signs of our
// own texts. ImGui writes from left to right without joining letters, as others need it.
constexpr ImWchar glyphs[] = {0x20,   0x24f,  0x370,      0x3ff,      0x400,  0x52f,
                              0x531,  0x58f,  0x10a0,     0x10ff,     0x1e00, 0x1eff,
                              0x2010, 0x2027, hollow_box, hollow_box, 0};

}  // namespace

std::array<ImFont*, 3> set_fonts(ImGuiPass& pass, const std::array<double, 3>& heights_pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    const auto data = text_font();
    std::array<ImFont*, 3> fonts;
    std::transform(heights_pixels.begin(), heights_pixels.end(), fonts.begin(), [&](double height) {
        ImFontConfig config;
        config.FontDataOwnedByAtlas = false;
        config.OversampleH = 2;
        // ImGui takes a writable pointer and leaves the data alone.
        ImFont* const font =
            atlas.AddFontFromMemoryTTF(const_cast<std::byte*>(data.data()), int(data.size()),
                                       float(std::round(height)), &config, glyphs);
        font->FallbackChar = hollow_box;
        return font;
    });
    atlas.Build();
    pass.upload_fonts();
    return fonts;
}

}  // namespace theatron::window
