// SPDX-License-Identifier: Apache-2.0
#include "publish/own_camera.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "registration/head_finder.h"

namespace theatron::publish {
namespace {

constexpr double nearest_m = 0.25, farthest_m = 2.5, bin_m = 0.05;
// A person's head and trunk lie within this depth of their nearest point.
constexpr double person_depth_m = 0.5;
// Share of the image's pixels that a person covers at least.
constexpr double least_share = 0.02;
constexpr double trunk_radius_m = 0.35, head_height_m = 0.22, head_radius_m = 0.14;
constexpr double eyes_below_top_m = 0.115;
constexpr int step = 4;  // pixels

// The camera's pose in a frame with y up. Only its rotation, unless the place is known.
Pose upright_from_camera(const Calibration& calibration) {
    return calibration.registered ? calibration.room_from_camera : Pose{Quat{0, 1, 0, 0}, {}};
}

// Points from nearest_m to farthest_m in the upright frame, and their distances along the axis.
struct Points {
    std::vector<Vec3> places;
    std::vector<double> depths_m;
    std::size_t pixels = 0;  // that were looked at
};

Points points_of(DepthView depth, const Calibration& calibration) {
    const Pose upright = upright_from_camera(calibration);
    Points points;
    for (int y = 0; y < depth.size.height; y += step)
        for (int x = 0; x < depth.size.width; x += step) {
            ++points.pixels;
            const double z = depth.row(y)[x] * calibration.depth_unit_mm * 1e-3;
            if (z < nearest_m || z > farthest_m)
                continue;
            if (const auto ray = unproject(calibration.depth, {double(x), double(y)})) {
                points.places.push_back(upright * (Vec3{ray->x, ray->y, 1} * z));
                points.depths_m.push_back(z);
            }
        }
    return points;
}

// The distance at which the nearest surface of a person's size begins.
std::optional<double> nearest_surface(const Points& points) {
    std::vector<std::size_t> bins(std::size_t(farthest_m / bin_m) + 1);
    for (const double z : points.depths_m)
        ++bins[std::size_t(z / bin_m)];
    const auto enough = std::size_t(least_share * double(points.pixels));
    const auto span = std::size_t(person_depth_m / bin_m);
    for (std::size_t first = 0; first + span <= bins.size(); ++first) {
        std::size_t sum = 0;
        for (std::size_t i = first; i < first + span; ++i)
            sum += bins[i];
        if (bins[first] > enough / span && sum >= enough)
            return double(first) * bin_m;
    }
    return std::nullopt;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Vec3 middle_of(const std::vector<Vec3>& places) {
    std::vector<double> x, y, z;
    for (const Vec3& place : places) {
        x.push_back(place.x);
        y.push_back(place.y);
        z.push_back(place.z);
    }
    return {median(x), median(y), median(z)};
}

double across(Vec3 a, Vec3 b) {
    return std::hypot(a.x - b.x, a.z - b.z);
}

// The eyes of a person who is the nearest large surface; camera frame.
std::optional<Vec3> eyes_of_nearest_surface(DepthView depth, const Calibration& calibration) {
    const Points all = points_of(depth, calibration);
    const auto front = nearest_surface(all);
    if (!front)
        return std::nullopt;
    std::vector<Vec3> body;
    for (std::size_t i = 0; i < all.places.size(); ++i)
        if (all.depths_m[i] >= *front && all.depths_m[i] < *front + person_depth_m)
            body.push_back(all.places[i]);
    const Vec3 trunk = middle_of(body);
    std::erase_if(body, [&](Vec3 place) { return across(place, trunk) > trunk_radius_m; });
    if (body.empty())
        return std::nullopt;

    // A few points above the head are noise.
    std::vector<double> heights;
    for (const Vec3& place : body)
        heights.push_back(place.y);
    const auto top_rank = std::ptrdiff_t(heights.size() / 100);
    std::nth_element(heights.begin(), heights.begin() + top_rank, heights.end(),
                     std::greater<double>());
    const double top = heights[std::size_t(top_rank)];
    std::vector<Vec3> head;
    for (const Vec3& place : body)
        if (place.y > top - head_height_m)
            head.push_back(place);
    const Vec3 rough = middle_of(head);
    std::erase_if(head, [&](Vec3 place) { return across(place, rough) > head_radius_m; });
    if (head.empty())
        return std::nullopt;
    const Vec3 middle = middle_of(head);
    return inverse(upright_from_camera(calibration)) *
           Vec3{middle.x, top - eyes_below_top_m, middle.z};
}

}  // namespace

std::optional<Eyes> find_eyes(DepthView depth, const Calibration& calibration) {
    const registration::SurfaceCamera camera(calibration.depth, calibration.depth_unit_mm);
    const Quat camera_from_upright = inverse(upright_from_camera(calibration)).rotation;
    const auto head =
        registration::find_head(camera, depth, rotate(camera_from_upright, {0, 1, 0}));
    if (head && head->middle.z < farthest_m)
        return Eyes{head->camera_from_head.translation, true};
    const auto guess = eyes_of_nearest_surface(depth, calibration);
    return guess ? std::optional(Eyes{*guess}) : std::nullopt;
}

Pose person_from_camera(const Calibration& calibration, std::optional<Vec3> eyes_in_camera) {
    const Pose upright = upright_from_camera(calibration);
    const Vec3 eyes = upright * eyes_in_camera.value_or(Vec3{0, 0, usual_eye_distance_m});
    const Vec3 ahead = upright.translation - eyes;
    const double yaw = std::hypot(ahead.x, ahead.z) > 1e-3 ? std::atan2(-ahead.x, -ahead.z) : 0;
    const Pose upright_from_person{rotation_about({0, 1, 0}, yaw), eyes};
    return inverse(upright_from_person) * upright;
}

}  // namespace theatron::publish
