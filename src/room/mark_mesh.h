// SPDX-License-Identifier: Apache-2.0
// The shape of a mark, in the frame of its points. Pure functions, metres.
#pragma once

#include <string>

#include "render/scene_frame.h"
#include "session/mark.h"

namespace theatron::room {

// A tube along a stroke and a distance, with balls at the ends of the latter; an arrow with a cone
// at its tip; a pin with its point on the surface. Tubes lie on the surface.
render::MeshData make_mark_mesh(const session::Mark& mark);

// The text beside a mark: the author's initials, a pin's number before them, and a distance's
// length with its expanded uncertainty (twice the deviation, about 95 %).
std::string label_of(const session::Mark& mark);
Vec3 label_place(const session::Mark& mark);

}  // namespace theatron::room
