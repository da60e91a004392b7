// SPDX-License-Identifier: Apache-2.0
#include "room/pointers.h"

#include "room/people.h"
#include "room/srgb.h"

namespace theatron::room {
namespace {

constexpr double ball_m = 0.01;  // of the mesh, scaled below
constexpr double dots_apart_m = 0.04, dot_m = 0.004;
// The dot at the end.
constexpr double end_m = 0.006, end_half_widths = 3;
// It is tested nearer than it is, as marks are: the surface's noise does not cover it.
constexpr double before_m = 0.02, before_per_distance = 0.01;

}  // namespace

render::LinePiece pointer_end(Vec3 place) {
    return {place, place, end_m, end_m, end_half_widths, end_half_widths};
}

Pointers::Pointers() : ball_(render::make_sphere_mesh(ball_m, 8)), end_({pointer_end({})}) {}

void Pointers::add_to(render::SceneFrame& frame, const std::vector<Pointer>& pointers) const {
    for (const Pointer& pointer : pointers) {
        render::SurfaceLook look{color_of(pointer.id), 0, 0.6};
        look.unlit = true;
        const double reach = pointer.reach_m.value_or(free_reach_m);
        for (int i = 1; i * dots_apart_m < reach; ++i)
            frame.objects.push_back({&ball_,
                                     {{}, pointer.from + pointer.direction * (i * dots_apart_m)},
                                     look,
                                     false,
                                     render::PickId::none,
                                     dot_m / ball_m});
        if (!pointer.reach_m)
            continue;
        const Rgb color = srgb_of(look.base_color);
        const auto add_end = [&](Vec3 place) {
            frame.lines.push_back({&end_, {{}, place}, color, before_m, before_per_distance});
        };
        const Vec3 end = pointer.from + pointer.direction * reach;
        add_end(end);
        if (pointer.twin)
            add_end(*pointer.twin);
        frame.labels.push_back({pointer.name, end, color, render::LabelRank::name});
    }
}

}  // namespace theatron::room
