// SPDX-License-Identifier: Apache-2.0
#include "render/ball_scene.h"

#include <algorithm>
#include <optional>
#include <random>

#include "base/error.h"

namespace theatron::render {
namespace {

constexpr double ball_radius = 0.3;
constexpr Vec3 ball_middle{0, 1.1, 0};
constexpr Vec3 table_low{-0.6, 0.6, -0.4}, table_high{0.6, 0.7, 0.4};
constexpr double floor_radius = 1.6;

// The nearest point of the scene along a line, as a multiple of `direction`.
std::optional<double> hit(Vec3 from, Vec3 direction) {
    std::optional<double> nearest;
    const auto take = [&](double t) {
        if (t > 1e-6 && (!nearest || t < *nearest))
            nearest = t;
    };
    const Vec3 to_ball = ball_middle - from;
    const double a = dot(direction, direction), b = dot(direction, to_ball);
    const double under_root = b * b - a * (dot(to_ball, to_ball) - ball_radius * ball_radius);
    if (under_root > 0)
        take((b - std::sqrt(under_root)) / a);

    double enter = 0, leave = 1e9;
    const double origins[] = {from.x, from.y, from.z};
    const double steps[] = {direction.x, direction.y, direction.z};
    const double low[] = {table_low.x, table_low.y, table_low.z};
    const double high[] = {table_high.x, table_high.y, table_high.z};
    for (int axis = 0; axis < 3; ++axis) {
        const double t1 = (low[axis] - origins[axis]) / steps[axis];
        const double t2 = (high[axis] - origins[axis]) / steps[axis];
        enter = std::max(enter, std::min(t1, t2));
        leave = std::min(leave, std::max(t1, t2));
    }
    if (enter < leave)
        take(enter);

    const double t_floor = -from.y / direction.y;
    const Vec3 on_floor = from + direction * t_floor;
    if (on_floor.x * on_floor.x + on_floor.z * on_floor.z < floor_radius * floor_radius)
        take(t_floor);
    return nearest;
}

Rgb color_of(Vec3 place) {
    const auto wave = [](double v) { return std::uint8_t(std::lround(128 + 90 * std::sin(v))); };
    return {wave(23 * place.x + 5 * place.y), wave(19 * place.z + 3),
            wave(29 * place.y + 7 * place.x)};
}

// The scene along one pixel's direction: distance along the axis in millimetres.
struct Seen {
    double depth_mm = 0;
    Rgb color;
};
Seen look(const Pose& room_from_eye, Vec2 direction) {
    const Vec3 along = rotate(room_from_eye.rotation, {direction.x, direction.y, 1});
    const auto t = hit(room_from_eye.translation, along);
    if (!t)
        return {};
    return {*t * 1000, color_of(room_from_eye.translation + along * *t)};
}

void show(CloudSet& scene, int id, const Calibration& camera) {
    const BallSceneImages images = ball_scene_images(camera, 0, 0);
    scene.set_camera(CameraId(id), camera);
    if (scene.upload(CameraId(id), images.depth.view(), images.color.view()) != Status::ok)
        throw Error("The golden scene's images do not have the size of its calibration.");
}

}  // namespace

Calibration ball_scene_camera(int i, int count, double spread_degrees, Size depth, Size color) {
    const double step = count > 1 ? spread_degrees / (count - 1) : 0;
    const double angle = radians_of(step * i - (count > 1 ? spread_degrees / 2 : 0));
    Calibration calibration;
    calibration.depth = pinhole(depth, 75);
    calibration.color = pinhole(color, 90);
    calibration.color_from_depth.translation = {-0.03, 0, 0};
    calibration.registered = true;
    calibration.room_from_camera =
        look_at(Vec3{2 * std::sin(angle), 1.7, 2 * std::cos(angle)}, ball_scene_middle, {0, 1, 0});
    return calibration;
}

BallSceneImages ball_scene_images(const Calibration& calibration, double noise_mm, unsigned seed) {
    BallSceneImages images{DepthImage(calibration.depth.size), ColorImage(calibration.color.size)};
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1);
    const Pose& room_from_depth = calibration.room_from_camera;
    const Pose room_from_color = room_from_depth * inverse(calibration.color_from_depth);
    for (int y = 0; y < images.depth.size.height; ++y)
        for (int x = 0; x < images.depth.size.width; ++x)
            if (const auto ray = unproject(calibration.depth, {double(x), double(y)})) {
                const double mm = look(room_from_depth, *ray).depth_mm;
                const double measured = mm > 0 ? mm + noise_mm * noise(random) : 0;
                images.depth.view().row(y)[x] =
                    std::uint16_t(std::lround(measured / calibration.depth_unit_mm));
            }
    for (int y = 0; y < images.color.size.height; ++y)
        for (int x = 0; x < images.color.size.width; ++x)
            if (const auto ray = unproject(calibration.color, {double(x), double(y)}))
                images.color.view().row(y)[x] = look(room_from_color, *ray).color;
    return images;
}

Picture ball_scene_picture(const CameraView& view, Size size) {
    Picture picture{ColorImage(size), DepthImage(size)};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Vec2 direction{view.left + (view.right - view.left) * (x + 0.5) / size.width,
                                 view.top + (view.bottom - view.top) * (y + 0.5) / size.height};
            const Seen seen = look(view.room_from_eye, direction);
            picture.depth_mm.view().row(y)[x] = std::uint16_t(std::lround(seen.depth_mm));
            picture.color.view().row(y)[x] = seen.color;
        }
    return picture;
}

CameraView golden_view() {
    return view_towards({-0.2, 1.6, 1.7}, ball_scene_middle, 50, golden_picture_size);
}

void show_golden_scene(CloudSet& scene) {
    for (int i = 0; i < 2; ++i)
        show(scene, i, ball_scene_camera(i, 2, 80, {160, 144}, {320, 180}));
}

void show_mixed_golden_scene(CloudSet& scene) {
    Calibration wide = ball_scene_camera(0, 3, 100, {192, 90}, {200, 150});
    wide.depth.k = {0.15, -0.05, 0.01, 0.05, 0.01, 0};
    wide.depth_unit_mm = 0.25;
    Calibration registered = ball_scene_camera(1, 3, 100, {110, 130}, {});
    registered.color = registered.depth;
    registered.color_from_depth = {};
    Calibration colorless = ball_scene_camera(2, 3, 100, {161, 67}, {});
    colorless.color = {};
    int i = 0;
    for (const Calibration& camera : {wide, registered, colorless})
        show(scene, i++, camera);
}

}  // namespace theatron::render
