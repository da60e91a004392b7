// SPDX-License-Identifier: Apache-2.0
// Free places for shared screens around the operating table.
#pragma once

#include <optional>
#include <vector>

#include "geometry/screen.h"

namespace theatron::session {

// True if the screens, with their rims and captions, overlap. Screens that are tilted count with
// the upright box around them.
bool overlap(const ScreenPlace& a, const ScreenPlace& b);

// True if the screen touches no furniture of the usual virtual room (src/furniture), hides no
// monitor of it from the table, and is within its walls.
bool is_clear_of_furniture(const ScreenPlace& screen);

// A place for an upright screen of this size that overlaps none of `others` and is clear of the
// furniture: at the far side of the table if it can be, then at the right, the left and the near
// side, facing the table. nullopt: no place is free.
std::optional<Pose> free_screen_place(double width_m, double height_m,
                                      const std::vector<ScreenPlace>& others);

}  // namespace theatron::session
