// SPDX-License-Identifier: Apache-2.0
#include "viewer/pointing_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "room/pointers.h"

namespace theatron::viewer {
namespace {

constexpr Vec3 hand_from_eye{0.15, 0.25, 0.2};
constexpr double shares_of_way[] = {1, 0.5, 0.25, 0.125};
// A hand on the eye's own ray is so far ahead that its dots do not cover the place.
constexpr double share_on_ray = 0.7;
// The same place, as two rays meet a noisy surface.
constexpr double same_m = 0.02, same_per_distance = 0.01;

constexpr double ring_radii[] = {0.005, 0.01};  // shares of the picture's height
constexpr int ring_rays = 8;
constexpr double same_surface_m = 0.05;

// The middle of those places that are on the nearest surface. The outermost of them are at its
// edge, where the next picture may have measured nothing.
Vec3 middle_of_nearest(const std::vector<Vec3>& places, Vec3 eye, const MetPlace& met) {
    const auto is_nearer = [&](Vec3 a, Vec3 b) { return length(a - eye) < length(b - eye); };
    const Vec3 nearest = *std::min_element(places.begin(), places.end(), is_nearer);
    Vec3 sum;
    int count = 0;
    for (const Vec3 place : places)
        if (length(place - eye) < length(nearest - eye) + same_surface_m) {
            sum = sum + place;
            ++count;
        }
    const Vec3 middle = sum * (1.0 / count);
    const auto there = met({eye, normalized(middle - eye)});
    return there && length(*there - middle) < same_surface_m ? *there : nearest;
}

}  // namespace

std::optional<Vec3> pointed_place(const RayThrough& ray_through, double aspect, Vec2 pointer,
                                  const MetPlace& met) {
    const render::PickRay ray = ray_through(pointer);
    if (const auto place = met(ray))
        return place;
    for (const double radius : ring_radii) {
        std::vector<Vec3> places;
        for (int i = 0; i < ring_rays; ++i) {
            const double angle = 2 * std::numbers::pi * i / ring_rays;
            const Vec2 around{pointer.x + radius * std::cos(angle) / aspect,
                              pointer.y + radius * std::sin(angle)};
            if (const auto place = met(ray_through(around)))
                places.push_back(*place);
        }
        if (!places.empty())
            return middle_of_nearest(places, ray.from, met);
    }
    return std::nullopt;
}

render::PickRay pointing_ray(const render::CameraView& view, Vec2 pointer, const MetPlace& met) {
    const Vec3 eye = view.room_from_eye.translation;
    const RayThrough through = [&](Vec2 at) { return render::ray_through(view, at); };
    const double aspect = (view.right - view.left) / (view.bottom - view.top);
    const auto place = pointed_place(through, aspect, pointer, met);
    const Vec3 to =
        place.value_or(eye + normalized(through(pointer).direction) * room::Pointers::free_reach_m);
    for (const double share : shares_of_way) {
        const Vec3 from = view.room_from_eye * (hand_from_eye * share);
        const double distance_m = length(to - from);
        if (distance_m < same_m)
            continue;
        const render::PickRay ray{from, (to - from) * (1 / distance_m)};
        const auto first = met(ray);
        if (place ? first && length(*first - to) < same_m + same_per_distance * distance_m : !first)
            return ray;
    }
    return place ? ray_along(eye, to) : render::PickRay{eye, normalized(to - eye)};
}

render::PickRay ray_along(Vec3 eye, Vec3 place) {
    return {eye + (place - eye) * share_on_ray, normalized(place - eye)};
}

Pose hand_on(const render::PickRay& ray) {
    const Vec3 up = std::abs(ray.direction.y) > 0.999 ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
    return look_at(ray.from, ray.from + ray.direction, up) * Pose{Quat{0, 1, 0, 0}, {}};
}

}  // namespace theatron::viewer
