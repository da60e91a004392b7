// SPDX-License-Identifier: Apache-2.0
// The texts over the picture: a line of facts at the bottom, a message in the
// middle, notices, and the help.
#pragma once

#include <string>
#include <vector>

namespace theatron::xr {

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

    bool operator==(const PanelButton&) const = default;
};
struct PanelRow {
    std::string text, detail;  // the detail is smaller and below
    std::vector<PanelButton> buttons;

    bool operator==(const PanelRow&) const = default;
};
struct Panel {
    std::string title;
    std::vector<PanelRow> rows;

    bool operator==(const Panel&) const = default;
};

struct OverlayContent {
    std::vector<Fact> facts;
    // Large in the middle, over a darkened picture, with a smaller line below.
    std::string message, detail;
    std::string warning;  // at the top, while its cause lasts
    std::string notice;   // below it, for a recent event
    bool help = false;
    std::vector<Panel> panels;  // below each other

    bool operator==(const OverlayContent&) const = default;
};

}  // namespace theatron::xr
