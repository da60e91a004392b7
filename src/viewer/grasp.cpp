// SPDX-License-Identifier: Apache-2.0
#include "viewer/grasp.h"

#include <algorithm>
#include <cmath>

namespace theatron::viewer {

Grasp::Grasp(const Pose& room_from_object, const render::PickRay& ray, Vec3 place)
    : ray_(ray),
      distance_m_(std::clamp(length(place - ray.from), least_distance_m, largest_distance_m)),
      place_from_object_{room_from_object.rotation, room_from_object.translation - place} {}

void Grasp::approach(double clicks) {
    distance_m_ = std::clamp(distance_m_ * std::pow(approach_per_click, clicks), least_distance_m,
                             largest_distance_m);
}

void Grasp::turn(double clicks) {
    const Pose turned{rotation_about({0, 1, 0}, radians_of(turn_per_click * clicks)), {}};
    place_from_object_ = turned * place_from_object_;
}

Pose Grasp::room_from_object() const {
    const Vec3 place = ray_.from + normalized(ray_.direction) * distance_m_;
    return Pose{{}, place} * place_from_object_;
}

}  // namespace theatron::viewer
