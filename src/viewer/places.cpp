// SPDX-License-Identifier: Apache-2.0
#include "viewer/places.h"

#include <algorithm>
#include <cmath>

#include "phrases/phrase.h"
#include "room/moving.h"

namespace theatron::viewer {
namespace {

constexpr double side_distance_m = 0.9, above_m = 1.0, from_above_m = 2.2,
                 overview_distance_m = 2.6, overview_height_m = 2.1, beside_m = 0.6,
                 elbow_room_m = 0.45;

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The point that the cameras look at, and the horizontal direction to it from the first one.
struct Sight {
    Vec3 middle, ahead;
};

std::optional<Sight> sight_of(const ViewableCameras& cameras, bool registered_only) {
    std::vector<double> x, y, z;
    Vec3 towards{};
    for (const auto& [id, frame] : cameras.newest) {
        const auto calibration = cameras.calibrations.find(id);
        if (calibration == cameras.calibrations.end() ||
            (registered_only && !calibration->second.registered))
            continue;
        const Vec3 point = render::point_of_interest(calibration->second, frame->depth.view());
        if (x.empty())
            towards = point - calibration->second.room_from_camera.translation;
        x.push_back(point.x);
        y.push_back(point.y);
        z.push_back(point.z);
    }
    if (x.empty())
        return std::nullopt;
    towards.y = 0;
    return Sight{{median(x), median(y), median(z)},
                 length(towards) > 1e-3 ? normalized(towards) : Vec3{0, 0, -1}};
}

}  // namespace

std::vector<Place> places_of(const ViewableCameras& cameras) {
    const auto sight = sight_of(cameras, true);
    if (!sight)
        return {};
    const Vec3 middle = sight->middle, ahead = sight->ahead;
    const Vec3 up{0, 1, 0}, side = cross(ahead, up);
    const auto standing = [&](Vec3 from, double height) {
        const Vec3 eye{middle.x + from.x, height, middle.z + from.z};
        return look_at(eye, middle, up);
    };
    return {{say(Phrase::surgeons_side), standing(side * side_distance_m, room::standing_eyes_m)},
            {say(Phrase::opposite), standing(side * -side_distance_m, room::standing_eyes_m)},
            {say(Phrase::above_situs), look_at(middle + up * above_m, middle, ahead)},
            {say(Phrase::overview), standing(ahead * -overview_distance_m, overview_height_m)}};
}

std::optional<Pose> from_above(const ViewableCameras& cameras) {
    const auto sight = sight_of(cameras, false);
    if (!sight)
        return std::nullopt;
    return look_at(sight->middle + Vec3{0, from_above_m, 0}, sight->middle, sight->ahead);
}

Pose beside(const Pose& room_from_head, const std::vector<Vec3>& heads) {
    const Pose eye = room_from_head * Pose{Quat{0, 1, 0, 0}, {}};
    const Vec3 right = rotate(eye.rotation, {1, 0, 0});
    const double flat = std::hypot(right.x, right.z);
    const Vec3 aside = flat > 1e-3 ? Vec3{right.x / flat, 0, right.z / flat} : Vec3{1, 0, 0};
    const auto is_free = [&](Vec3 place) {
        return std::none_of(heads.begin(), heads.end(), [&](Vec3 head) {
            return std::hypot(head.x - place.x, head.z - place.z) < elbow_room_m;
        });
    };
    // One place is free: each head takes two at most.
    for (std::size_t i = 1; i <= heads.size() + 1; ++i)
        for (const double side : {1.0, -1.0})
            if (const Vec3 place = eye.translation + aside * (side * double(i) * beside_m);
                is_free(place))
                return {eye.rotation, place};
    return {eye.rotation, eye.translation + aside * beside_m};
}

}  // namespace theatron::viewer
