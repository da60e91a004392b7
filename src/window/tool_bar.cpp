// SPDX-License-Identifier: Apache-2.0
#include "window/tool_bar.h"

#include <algorithm>
#include <cmath>

namespace theatron::window {
namespace {

constexpr double least_cell = 40;
// In text heights.
constexpr double widest_cell = 5.4, labelled_height = 3.2, plain_height = 2.4;
// Lower windows, in text heights, have no space for labels.
constexpr double labelled_from = 22;

}  // namespace

ToolBarLayout tool_bar_layout(std::size_t tools, Size window, double text_pixels) {
    ToolBarLayout layout;
    layout.has_labels = window.height >= labelled_from * text_pixels;
    const double height = std::max(
        least_cell, std::round(text_pixels * (layout.has_labels ? labelled_height : plain_height)));
    const double top = window.height - height, bottom = window.height;
    layout.bar = {0, top, double(window.width), bottom};
    // The cell of the dot stands at the left, the others in the middle of what is left.
    const double cells = double(tools) + 1;
    const double width = std::floor(std::min(widest_cell * text_pixels, window.width / cells));
    layout.dot = {0, top, width, bottom};
    const double together = width * double(tools);
    double left = std::clamp((window.width - together) / 2, width, window.width - together);
    left = std::floor(left);
    for (std::size_t i = 0; i < tools; ++i, left += width)
        layout.tools.push_back({left, top, left + width, bottom});
    return layout;
}

}  // namespace theatron::window
