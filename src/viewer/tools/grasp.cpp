// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/grasp.h"

#include <algorithm>
#include <cmath>

namespace theatron::viewer {

Grip grip_of_hand(const Pose& room_from_aim) {
    constexpr double least_m = 0.05, largest_m = 8;
    return {{room_from_aim.translation, rotate(room_from_aim.rotation, {0, 0, -1})},
            room_from_aim.rotation,
            least_m,
            largest_m};
}

Grasp::Grasp(const Pose& room_from_object, const Grip& grip, Vec3 place)
    : grip_(grip), grip_from_object_(inverse(Pose{grip.rotation, place}) * room_from_object) {
    set_distance(length(place - grip.ray.from));
}

void Grasp::set_distance(double metres) {
    distance_m_ = std::clamp(metres, grip_.least_distance_m, grip_.largest_distance_m);
}

void Grasp::approach(double clicks) {
    set_distance(distance_m_ * std::pow(approach_per_click, clicks));
}

void Grasp::push(double metres) {
    set_distance(distance_m_ + metres);
}

void Grasp::turn(double degrees) {
    const Pose grip{grip_.rotation, {}};
    const Pose turned{rotation_about({0, 1, 0}, radians_of(degrees)), {}};
    grip_from_object_ = inverse(grip) * turned * grip * grip_from_object_;
    grip_from_object_.rotation = normalized(grip_from_object_.rotation);
}

Pose Grasp::room_from_grip() const {
    return {grip_.rotation, grip_.ray.from + normalized(grip_.ray.direction) * distance_m_};
}

Pose Grasp::room_from_object() const {
    return room_from_grip() * grip_from_object_;
}

}  // namespace theatron::viewer
