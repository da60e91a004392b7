// SPDX-License-Identifier: Apache-2.0
// The parts of the OR screen as shapes and letters of Dear ImGui.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "or_screen/drawing.h"

namespace theatron::or_screen {

struct Fonts {
    ImFont* small = nullptr;  // capitals of Layout::letter
    ImFont* name = nullptr;
    ImFont* large = nullptr;
};

class Painter {
public:
    // `list` and the fonts must outlive it. `letter`: Layout::letter.
    Painter(ImDrawList& list, const Fonts& fonts, double letter)
        : list_(list), fonts_(fonts), letter_(float(letter)) {}

    void ground(Size screen);
    // The picture with pointers, marks and its warning; `picture` may be null.
    void camera(const Content& content, const Rect& rect, const render::PictureTexture* picture);
    void written(const std::vector<std::string>& messages, const Rect& rect);
    void caption(const Content& content, const Rect& rect);
    void room(const Content& content, const Rect& rect, const render::Texture* picture);
    void monitor(const Content& content, const Rect& rect, const render::PictureTexture* slice);
    void card(const PersonCard& card, bool two_lines, const Rect& rect);
    void note_card(const std::string& words, const Rect& rect);
    void message(const Content& content, Size screen, Vec2 by);

private:
    ImVec2 measure(const ImFont* font, const std::string& text, float wrap = 0) const;
    // The beginning of the text that fits, with dots if it is not all.
    std::string shortened(const ImFont* font, const std::string& text, float width) const;
    // The text in as few lines as hold it, at most two: only the second one is ever shortened.
    std::vector<std::string> in_lines(const ImFont* font, const std::string& text,
                                      float width) const;
    void text(const ImFont* font, ImVec2 place, ImU32 color, const std::string& words,
              float wrap = 0, float scale = 1);
    void centred(const ImFont* font, const Rect& rect, ImU32 color, const std::string& words,
                 float scale = 1);
    void badge(ImVec2 middle, Rgb color, const std::string& initials);
    // `initials` (may be empty) on `color` and `words` on a dark ground, next to `at`, in `area`.
    void label(ImVec2 at, Rgb color, const std::string& initials, ImU32 words_color,
               const std::string& words, const Rect& area);
    void ring(ImVec2 at, ImU32 color, Sight sight);
    // First all rings, then the labels, which cover no ring.
    void pointers(const std::vector<PointerMark>& pointers, const Rect& area, Size picture);
    void mark(const PictureMark& mark, const Rect& area, Size picture);

    ImDrawList& list_;
    const Fonts& fonts_;
    float letter_;
    std::vector<Rect> there_;  // that labels do not cover
};

}  // namespace theatron::or_screen
