// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "render/test_context.h"
#include "window/imgui_fonts_native.h"
#include "window/overlay_native.h"

namespace theatron::window {
namespace {

TEST(Overlay, ALongNameMakesAPanelHigherInsteadOfVeryWide) {
    // There is no window: the picture is lost, and only the places on it count. The driver's
    // complaint about that is not one about the tests' shared context.
    render::test_context().release();
    const render::OffscreenContext without_window(render::tested_gl());
    Overlay overlay;
    const auto draw = [&](const std::string& name) {
        OverlayContent content;
        content.panels = {{"Case", {{name, "12 MB", {{"Open", 1}}}}}};
        overlay.draw(content, {1280, 720}, 16);
    };
    const auto button = [&] {
        for (int x = 0; x < 1280; x += 4)
            for (int y = 0; y < 720; y += 4)
                if (overlay.command_at({x / 1280.0, y / 720.0}))
                    return Vec2{double(x), double(y)};
        return Vec2{};
    };
    draw("Liver");
    EXPECT_TRUE(overlay.covers({0.03, 0.08}));
    EXPECT_FALSE(overlay.covers({0.03, 0.18}));
    draw(std::string(64, 'W'));
    EXPECT_FALSE(overlay.covers({0.6, 0.08})) << "bounded";
    EXPECT_TRUE(overlay.covers({0.03, 0.13})) << "a second line";
    EXPECT_GT(button().x, 0) << "it can still be opened";
    EXPECT_LT(button().x, 0.6 * 1280);
}

TEST(Overlay, TheKeyboardReachesRowsThatAreScrolledOut) {
    render::test_context().release();
    const render::OffscreenContext without_window(render::tested_gl());
    Overlay overlay;
    Panel panel{"Study", {}};
    panel.keyboard = 1;
    for (int i = 0; i < 60; ++i)
        panel.rows.push_back({"a paragraph", "", {}});
    panel.rows.push_back({"", "", {{"Yes", 1}, {"No", 2}}});
    OverlayContent content;
    const auto draw = [&] {
        content.panels = {panel};
        overlay.draw(content, {1280, 720}, 16);
    };
    const auto in_sight = [&](int command) {
        for (int x = 0; x < 1280; x += 4)
            for (int y = 0; y < 720; y += 4)
                if (overlay.command_at({x / 1280.0, y / 720.0}) == command)
                    return true;
        return false;
    };
    draw();
    ASSERT_EQ(overlay.controls(), 2u);
    EXPECT_EQ(overlay.command_of(1), 2);
    EXPECT_FALSE(in_sight(1) || in_sight(2));
    content.focused = 1;
    draw();
    EXPECT_TRUE(in_sight(1) && in_sight(2));
    overlay.scroll({0.03, 0.08}, -100);
    draw();
    EXPECT_FALSE(in_sight(1)) << "the wheel goes on where the keyboard stays";

    // Page by page, and another step begins with its first row.
    content.focused.reset();
    int pages = 0;
    for (draw(); !in_sight(1) && pages < 10; draw(), ++pages)
        ASSERT_TRUE(overlay.turn_page(1));
    EXPECT_GT(pages, 1) << "no paragraph is passed over";
    panel.keyboard = 2;
    draw();
    EXPECT_FALSE(in_sight(1));
    panel.rows.resize(3);
    draw();
    EXPECT_FALSE(overlay.turn_page(1)) << "all is in sight";
}

TEST(Overlay, LettersThatTheFontLacksAreHollowBoxes) {
    render::test_context();
    ImGuiContext* const context = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    {
        ImGuiPass pass;
        for (const ImFont* font : set_fonts(pass, {14, 20, 28})) {
            for (const ImWchar known : {0x41, 0x416, 0x3b1, 0x1ec5, 0x10d0})
                EXPECT_NE(font->FindGlyphNoFallback(known), nullptr) << known;
            EXPECT_EQ(font->FindGlyph(0x5c71)->Codepoint, 0x25a1u);
        }
    }
    ImGui::DestroyContext(context);
}

}  // namespace
}  // namespace theatron::window
