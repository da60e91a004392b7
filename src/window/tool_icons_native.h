// SPDX-License-Identifier: Apache-2.0
// The icons of the bar as strokes: those of the browser's page, whose drawings have 24 units a
// side.
#pragma once

#include <imgui.h>

#include "window/tool_bar.h"

namespace theatron::window {

// Draws the icon into the square with this top left corner. `stroke` is the width of its lines;
// both in pixels.
void draw_icon(ImDrawList& list, ToolIcon icon, ImVec2 corner, float side, float stroke,
               ImU32 color);
// The line that says off, with a gap on both sides in the colour of the ground.
void draw_cross(ImDrawList& list, ImVec2 corner, float side, float stroke, ImU32 color,
                ImU32 ground);
// A circle, a triangle or a square.
void draw_dot(ImDrawList& list, PictureDot::Level level, ImVec2 corner, float side, ImU32 color);

}  // namespace theatron::window
