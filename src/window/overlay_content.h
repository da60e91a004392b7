// SPDX-License-Identifier: Apache-2.0
// The texts over the picture: a line of facts at the bottom, a message in the
// middle, notices, and the help.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/vec.h"
#include "image/image.h"
#include "window/tool_bar.h"

namespace theatron::window {

// One field of the line at the bottom.
struct Fact {
    std::string label, value;
    bool warning = false;

    bool operator==(const Fact&) const = default;
};

// A panel at the left: rows of text with buttons.
struct PanelButton {
    std::string label;
    int command = 0;  // chosen by the owner of the panel
    // The person sees something else then, which the panel may hide.
    bool leads_away = false;

    bool operator==(const PanelButton&) const = default;
};
struct PanelSlider {
    double value = 0, lowest = 0, highest = 1;
    int command = 0;  // as of a button, with the value

    bool operator==(const PanelSlider&) const = default;
};
struct PanelRow {
    std::string text, detail;  // the detail is smaller and below, in one or several lines
    std::vector<PanelButton> buttons;
    std::optional<PanelSlider> slider = {};  // left of the buttons
    // The text that its buttons belong to, for a screen reader; nullopt: that of the row, or else
    // of the row above.
    std::optional<std::string> subject = {};

    bool operator==(const PanelRow&) const = default;
};
struct Panel {
    std::string title;
    std::vector<PanelRow> rows;
    // Not 0: the keyboard comes to this panel first. With another number its buttons are others,
    // and the keyboard leaves the one that it was on.
    std::uint64_t keyboard = 0;
    bool large = false;  // buttons are large enough for a person in a hurry, or a finger

    bool operator==(const Panel&) const = default;
};

// A plain picture at the right, with a legend of its colours below it if it needs one.
struct OverlayPicture {
    std::string title;
    std::shared_ptr<const ColorImage> pixels;  // never null
    std::vector<Rgb> legend;                   // its colours from left to right; empty: none
    std::string legend_from, legend_to;        // the values of the first and the last colour
    bool large = false;                        // alone in the middle
    int command = 0;                           // of a click on it, as for buttons

    bool operator==(const OverlayPicture&) const = default;
};

struct OverlayContent {
    std::vector<Fact> facts;
    // Large in the middle, over a darkened picture, with a smaller line below.
    std::string message, detail;
    // The same below the panels, where there is no message: the picture no longer shows the
    // present.
    std::string cover;
    std::string warning;  // at the top, while its cause lasts
    std::string notice;   // below it, for a recent event
    bool help = false;
    std::vector<Panel> panels;             // below each other
    std::vector<OverlayPicture> pictures;  // in rows of three, or a large one
    // That is being drawn with the mouse: two corners, in shares of the window's width and height.
    std::optional<std::pair<Vec2, Vec2>> rectangle = {};
    std::optional<PanelRow> bar = {};   // above the facts, as wide as the window
    std::vector<PanelRow> offers = {};  // at the top: notices with buttons
    std::optional<ToolBar> tools = {};  // at the bottom, below all others
    std::optional<std::size_t> hovered = {}, focused = {};  // controls, as Overlay counts them

    bool operator==(const OverlayContent&) const = default;
};

}  // namespace theatron::window
