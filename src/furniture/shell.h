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

// A side's picture, in sRGB: the material's colours, made in steps of some milliseconds.
class SidePicture {
public:
    // As it is seen in `light`, which must live until the last step; null: without any light.
    SidePicture(const Extent& extent, Side side, const BakedLight* light);

    // True once the picture is complete; to be called until then.
    bool step();
    const ColorImage& image() const { return image_; }

private:
    void light_points();
    void paint_rows();
    double lightness(int x, int y) const;

    Extent extent_;
    Side side_;
    const BakedLight* light_;
    // Light changes slowly: it is computed at a coarse grid and interpolated.
    Image<float> grid_;
    int lit_rows_ = 0, painted_rows_ = 0;
    ColorImage image_;
};

// How rough the side is, see render::SurfaceLook.
double roughness_of(Side side);

}  // namespace theatron::furniture
