// SPDX-License-Identifier: Apache-2.0
// The bar of buttons at the bottom of a window: its content in plain values, and where its cells
// stand.
//
// Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "image/view.h"

namespace theatron::window {

enum class ToolIcon { microphone, webcam, point, draw, patient_case, people, leave, more };

struct Tool {
    ToolIcon icon{};
    std::string label, hint;  // below the icon; above the bar while the mouse or the focus is there
    bool pressed = false;     // what it stands for is on
    bool crossed = false;     // a line through the icon, in the colour of an alarm
    bool alarm = false;       // the label has that colour, too
    std::size_t badge = 0;    // a number at the icon; 0: none
    int command = 0;          // as for buttons of a panel

    bool operator==(const Tool&) const = default;
};

// How the picture is: a circle, a triangle or a square, so that no colour has to be told from
// another one.
struct PictureDot {
    enum class Level { good, slow, bad } level = Level::good;
    std::string words, hint;
    int command = 0;

    bool operator==(const PictureDot&) const = default;
};

struct ToolBar {
    PictureDot dot;
    std::vector<Tool> tools;

    bool operator==(const ToolBar&) const = default;
};

// In pixels from the window's top left corner.
struct BarCell {
    double left = 0, top = 0, right = 0, bottom = 0;

    double width() const { return right - left; }
    double height() const { return bottom - top; }
};

struct ToolBarLayout {
    BarCell bar, dot;
    std::vector<BarCell> tools;
    bool has_labels = true;  // false in a low window: icons alone
};

// Cells of one width beside each other. Every cell is at least 40 pixels wide and high in windows
// of at least 40 pixels for each of them and the dot; in narrower ones they share the width.
// `text_pixels` is the height of a normal text.
ToolBarLayout tool_bar_layout(std::size_t tools, Size window, double text_pixels);

}  // namespace theatron::window
