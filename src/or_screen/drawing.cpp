// SPDX-License-Identifier: Apache-2.0
#include "or_screen/drawing.h"

#include "or_screen/painter.h"
#include "phrases/phrase.h"
#include "window/imgui_fonts_native.h"

namespace theatron::or_screen {
namespace {

// A capital letter of the font, in shares of a line's height.
constexpr double capital = 0.626;

}  // namespace

struct Drawing::Parts {
    ImGuiContext* context = nullptr;
    window::ImGuiPass pass;
    double letter = 0;  // for which the fonts are made
    Fonts fonts;

    Parts() : context(ImGui::CreateContext()) {
        ImGui::GetIO().IniFilename = nullptr;  // nothing is remembered in files
    }
    ~Parts() { ImGui::DestroyContext(context); }

    void make_fonts(double pixels);
};

void Drawing::Parts::make_fonts(double pixels) {
    const double line = pixels / capital;
    const auto made = window::set_fonts(pass, {line, 1.2 * line, 1.9 * line});
    fonts = {made[0], made[1], made[2]};
    letter = pixels;
}

Drawing::Drawing() : parts_(std::make_unique<Parts>()) {}
Drawing::~Drawing() = default;

void Drawing::draw(const Content& content, const Layout& layout, Vec2 by, const Pictures& pictures,
                   const render::DrawTarget& target) {
    Parts& p = *parts_;
    ImGui::SetCurrentContext(p.context);
    if (p.letter != layout.letter)
        p.make_fonts(layout.letter);
    ImGui::GetIO().DisplaySize = {float(target.size.width), float(target.size.height)};
    ImGui::GetIO().DeltaTime = 1.0f / 60;  // nothing here moves by itself
    ImGui::NewFrame();

    Painter painter(*ImGui::GetForegroundDrawList(), p.fonts, layout.letter);
    painter.ground(target.size);
    const Rect picture = moved(layout.picture, by);
    painter.camera(content, picture, pictures.camera);
    painter.caption(content, moved(layout.caption, by));
    painter.room(content, moved(layout.room, by), pictures.room);
    if (layout.monitor.width > 0)
        painter.monitor(content, moved(layout.monitor, by), pictures.slice);
    for (std::size_t i = 0; i < layout.cards.size(); ++i) {
        const Rect card = moved(layout.cards[i], by);
        if (i < content.people.size())
            painter.card(content.people[i], layout.two_lines, card);
        else if (content.people_left_out > 0)
            painter.note_card("and " + std::to_string(content.people_left_out) + " more", card);
        else if (content.is_alone)
            painter.note_card(say(Phrase::nobody_here), card);
    }
    if (!content.message.empty())
        painter.message(content, target.size, by);

    ImGui::Render();
    p.pass.draw(*ImGui::GetDrawData(), target);
}

}  // namespace theatron::or_screen
