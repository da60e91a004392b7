// SPDX-License-Identifier: Apache-2.0
// The text font in the current Dear ImGui context.
#pragma once

#include <imgui.h>

#include <array>

#include "window/imgui_pass_native.h"

namespace theatron::window {

// Replaces all fonts of the current context by the text font in these line heights (pixels,
// rounded), and uploads its glyphs for `pass`. The context owns the returned fonts.
std::array<ImFont*, 3> set_fonts(ImGuiPass& pass, const std::array<double, 3>& heights_pixels);

}  // namespace theatron::window
