// SPDX-License-Identifier: Apache-2.0
// Floor, walls and ceiling of a room: their surfaces, and pictures of their materials. Vinyl with
// flecks runs up the walls in a curve; the walls have panels with joints, the ceiling tiles.
#pragma once

#include <array>

#include "furniture/baked_light.h"
#include "furniture/extent.h"
#include "image/image.h"
#include "render/scene_frame.h"

namespace theatron::furniture {

enum class Side { floor, ceiling, back, front, left, right };
inline constexpr std::array<Side, 6> all_sides{Side::floor, Side::ceiling, Side::back,
                                               Side::front, Side::left,    Side::right};

// Seen from inside. Together the sides are convex. (u, v) are places in the side's picture.
render::MeshData side_mesh(const Extent& extent, Side side);

// The material's colours, in sRGB, without any light.
ColorImage side_picture(const Extent& extent, Side side);
// The same as it is seen in this light.
ColorImage lit_side_picture(const Extent& extent, Side side, const BakedLight& light);

// How rough the side is, see render::SurfaceLook.
double roughness_of(Side side);

}  // namespace theatron::furniture
