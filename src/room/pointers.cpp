// SPDX-License-Identifier: Apache-2.0
#include "room/pointers.h"

#include <algorithm>
#include <cmath>

#include "room/facing.h"
#include "room/people.h"

namespace theatron::room {
namespace {

constexpr double ball_m = 0.01;  // of the mesh, scaled below
constexpr double dots_apart_m = 0.04, dot_m = 0.004;
constexpr double end_per_distance = 0.006, least_end_m = 0.006, largest_end_m = 0.02;
constexpr double name_per_distance = 0.016, least_name_m = 0.012, largest_name_m = 0.05;

}  // namespace

Pointers::Pointers() : ball_(render::make_sphere_mesh(ball_m, 8)) {}

void Pointers::add_to(render::SceneFrame& frame, const std::vector<Pointer>& pointers,
                      const render::CameraView& view) const {
    const Vec3 eye = view.room_from_eye.translation;
    for (const Pointer& pointer : pointers) {
        render::SurfaceLook look{color_of(pointer.id), 0, 0.6};
        look.unlit = true;
        const auto add = [&](Vec3 place, double radius_m) {
            frame.objects.push_back(
                {&ball_, {{}, place}, look, false, render::ObjectId::none, radius_m / ball_m});
        };
        const double reach = pointer.reach_m.value_or(free_reach_m);
        for (int i = 1; i * dots_apart_m < reach; ++i)
            add(pointer.from + pointer.direction * (i * dots_apart_m), dot_m);
        if (!pointer.reach_m)
            continue;
        const auto radius_at = [&](Vec3 place) {
            return std::clamp(end_per_distance * length(place - eye), least_end_m, largest_end_m);
        };
        const Vec3 end = pointer.from + pointer.direction * reach;
        const double distance = length(end - eye), radius = radius_at(end);
        add(end, radius);
        if (pointer.twin)
            add(*pointer.twin, radius_at(*pointer.twin));
        const double height =
            std::clamp(name_per_distance * distance, least_name_m, largest_name_m);
        const Pose place = facing(end, eye);
        frame.texts.push_back({pointer.name,
                               place * Pose{{}, {radius * 1.6, -radius * 1.2, -radius * 1.5}},
                               height,
                               {235, 240, 240}});
    }
}

}  // namespace theatron::room
