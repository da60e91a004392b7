// SPDX-License-Identifier: Apache-2.0
// Dear ImGui on a panel in the room. The picture is compared with tests/golden/panel.ppm; to accept
// a wanted change run this test with THEATRON_WRITE_GOLDEN=1 and look at the new one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>

#include "render/room_picture.h"
#include "render/test_context.h"
#include "window/imgui_fonts_native.h"
#include "window/imgui_pass_native.h"

namespace theatron::window {
namespace {

constexpr Size picture_size{192, 128}, panel_size{128, 64};
constexpr Rgb background{10, 40, 60};

class ImGuiPanelTest : public ::testing::Test {
protected:
    void SetUp() override {
        render::test_context();
        context = ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {64, 32};  // half of the panel's pixels: it is spread over all of them
        pass.emplace();
        set_fonts(*pass, {14, 20, 28});
        texture.emplace(panel_size);
    }
    void TearDown() override {
        texture.reset();
        pass.reset();
        ImGui::DestroyContext(context);
    }

    // A red bar at the top, a word below it, and a square that is cut in half by its clip.
    void draw_panel() {
        ImGui::NewFrame();
        ImDrawList* list = ImGui::GetForegroundDrawList();
        list->AddRectFilled({0, 0}, {64, 8}, IM_COL32(200, 30, 30, 255));
        list->AddText({4, 12}, IM_COL32(255, 255, 255, 255), "Pulse");
        list->PushClipRect({50, 10}, {64, 20});
        list->AddRectFilled({50, 10}, {60, 30}, IM_COL32(30, 200, 30, 255));
        list->PopClipRect();
        ImGui::Render();
        pass->draw(*ImGui::GetDrawData(), *texture, background);
    }

    // The panel in front of the eye, a little turned.
    ColorImage draw_room() {
        const render::SceneMesh quad(render::make_panel_mesh(1, 0.5));
        render::SceneFrame frame;
        render::SurfaceLook look{{1, 1, 1}};
        look.texture = &*texture;
        look.unlit = true;
        frame.objects.push_back({&quad, {rotation_about({0, 1, 0}, turned), {0, 0, 0.8}}, look});
        const render::CameraView view{{}, -0.75, 0.75, -0.5, 0.5};
        render::ScenePasses passes;
        return render::draw_and_read(&frame, {}, {view}, picture_size, &passes).color;
    }

    double turned = 0;
    ImGuiContext* context = nullptr;
    std::optional<ImGuiPass> pass;
    std::optional<render::SceneTexture> texture;
};

TEST_F(ImGuiPanelTest, APanelIsUprightAndCutWhereImGuiCutsIt) {
    draw_panel();
    const ColorImage drawn = draw_room();
    // The panel covers 160 x 80 pixels in the middle; a unit of ImGui's display is 2.5 of them.
    const auto at = [&](double x, double y) {
        return drawn.view().row(int(24 + 2.5 * y))[int(16 + 2.5 * x)];
    };
    EXPECT_EQ(at(2, 4), (Rgb{200, 30, 30}));
    EXPECT_EQ(at(2, 28), background);
    EXPECT_EQ(at(55, 15), (Rgb{30, 200, 30}));
    EXPECT_EQ(at(55, 25), background) << "cut off by its clip";
}

TEST_F(ImGuiPanelTest, LooksAsItLookedBefore) {
    turned = 0.6;
    draw_panel();
    const ColorImage drawn = draw_room();
    const std::string file = "tests/golden/panel.ppm", header = "P6\n192 128\n255\n";
    if (std::getenv("THEATRON_WRITE_GOLDEN")) {
        std::ofstream out(file, std::ios::binary);
        out << header;
        out.write(reinterpret_cast<const char*>(drawn.pixels.data()),
                  std::streamsize(drawn.pixels.size() * sizeof(Rgb)));
    }
    std::ifstream in(file, std::ios::binary);
    const std::string golden((std::istreambuf_iterator<char>(in)), {});
    ASSERT_EQ(golden.size(), header.size() + 3 * drawn.pixels.size()) << "cannot read " << file;
    double sum = 0;
    for (std::size_t i = 0; i < 3 * drawn.pixels.size(); ++i)
        sum += std::abs(reinterpret_cast<const std::uint8_t*>(drawn.pixels.data())[i] -
                        std::uint8_t(golden[header.size() + i]));
    // Drivers round differently at outlines.
    EXPECT_LT(sum / double(3 * drawn.pixels.size()), 0.5);
}

}  // namespace
}  // namespace theatron::window
