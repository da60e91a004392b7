// SPDX-License-Identifier: Apache-2.0
// The shape of a mark, in the frame of its points, and its text. Pure functions, metres.
#pragma once

#include <string>
#include <vector>

#include "render/scene_lines.h"
#include "session/mark.h"

namespace theatron::room {

// The pieces of a line along a stroke or a distance, with discs at the ends of the latter; an arrow
// with its head; a pin that stands on the surface.
std::vector<render::LinePiece> mark_line(const session::Mark& mark);

// The text beside a mark: the author's initials, a pin's number before them, and a distance's
// length with its expanded uncertainty (twice the deviation, about 95 %).
std::string label_of(const session::Mark& mark);
// The same for a small picture: a distance in whole millimetres, "306 \u00b1 5 mm", without
// initials.
std::string short_label_of(const session::Mark& mark);
render::LabelRank rank_of(session::MarkKind kind);
// The places beside which the text may stand, the best one first.
std::vector<Vec3> label_places(const session::Mark& mark);

}  // namespace theatron::room
