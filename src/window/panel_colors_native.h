// SPDX-License-Identifier: Apache-2.0
// The colours of all flat panels: those over the room, the entry form and the screen in the
// operating room. They are dark, since they are looked at in dim light beside bright pictures.
#pragma once

#include <imgui.h>

#include "image/image.h"

namespace theatron::window::colors {

constexpr ImU32 with_opacity(Rgb c, int opacity = 255) {
    return IM_COL32(c.r, c.g, c.b, opacity);
}

inline constexpr Rgb dark{12, 14, 18};  // behind everything
inline constexpr Rgb shade{8, 10, 14};  // over pictures
inline constexpr Rgb card_ground{22, 26, 33};

inline constexpr ImU32 ground = with_opacity(dark);
inline constexpr ImU32 bar = with_opacity(dark, 225);
inline constexpr ImU32 dense_bar = with_opacity(dark, 248);
inline constexpr ImU32 panel = with_opacity(dark, 240);
inline constexpr ImU32 card = with_opacity(card_ground);
inline constexpr ImU32 veil = with_opacity(shade, 170);
inline constexpr ImU32 dense_veil = with_opacity(shade, 225);
inline constexpr ImU32 ink = with_opacity(shade);  // on a bright colour

inline constexpr ImU32 text = IM_COL32(245, 247, 250, 255);
inline constexpr ImU32 label = IM_COL32(160, 172, 186, 255);
inline constexpr ImU32 warning = IM_COL32(255, 190, 70, 255);
inline constexpr ImU32 key = IM_COL32(140, 205, 255, 255);

inline constexpr ImU32 good = IM_COL32(84, 204, 128, 255);
inline constexpr ImU32 alarm = IM_COL32(255, 112, 96, 255);

inline constexpr ImU32 tool_pressed = IM_COL32(30, 84, 138, 255);
inline constexpr ImU32 tool_hovered = IM_COL32(40, 48, 60, 255);
inline constexpr ImU32 field = IM_COL32(38, 46, 58, 255);
inline constexpr ImU32 button = IM_COL32(52, 66, 84, 255);
inline constexpr ImU32 button_hovered = IM_COL32(66, 84, 106, 255);
inline constexpr ImU32 main_button = IM_COL32(36, 104, 176, 255);
inline constexpr ImU32 main_button_hovered = IM_COL32(48, 124, 204, 255);

}  // namespace theatron::window::colors
