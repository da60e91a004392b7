// SPDX-License-Identifier: Apache-2.0
#include "render/camera_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace theatron::render {
namespace {

constexpr Vec3 room_up{0, 1, 0};
// Depth range of a surface of interest, and the share of the samples that it fills.
constexpr double interest_depth_mm = 300;
constexpr std::size_t interest_share = 10;

}  // namespace

CameraView view_of_camera(const CameraModel& camera, const Pose& room_from_camera, Size picture) {
    CameraView view;
    view.room_from_eye = room_from_camera;
    // Pixel centres are whole numbers, so the picture begins half a pixel before 0.
    view.left = (-0.5 - camera.cx) / camera.fx;
    view.right = (camera.size.width - 0.5 - camera.cx) / camera.fx;
    view.top = (-0.5 - camera.cy) / camera.fy;
    view.bottom = (camera.size.height - 0.5 - camera.cy) / camera.fy;

    const double camera_aspect = double(camera.size.width) / camera.size.height;
    const double wider = double(picture.width) / picture.height / camera_aspect;
    const double half_width = (view.right - view.left) / 2, middle_x = view.left + half_width;
    const double half_height = (view.bottom - view.top) / 2, middle_y = view.top + half_height;
    view.left = middle_x - half_width * std::max(1.0, wider);
    view.right = middle_x + half_width * std::max(1.0, wider);
    view.top = middle_y - half_height * std::max(1.0, 1 / wider);
    view.bottom = middle_y + half_height * std::max(1.0, 1 / wider);
    return view;
}

CameraView view_towards(Vec3 eye, Vec3 target, double vertical_fov_degrees, Size picture) {
    CameraView view;
    view.room_from_eye = look_at(eye, target, room_up);
    view.bottom = std::tan(radians_of(vertical_fov_degrees) / 2);
    view.top = -view.bottom;
    view.right = view.bottom * picture.width / picture.height;
    view.left = -view.right;
    return view;
}

CameraView orbited(const CameraView& view, Vec3 pivot, double yaw_degrees, double pitch_degrees) {
    const Vec3 eye_right = rotate(view.room_from_eye.rotation, {1, 0, 0});
    const Quat turn = rotation_about(room_up, radians_of(yaw_degrees)) *
                      rotation_about(eye_right, radians_of(-pitch_degrees));
    CameraView result = view;
    result.room_from_eye.rotation = normalized(turn * view.room_from_eye.rotation);
    result.room_from_eye.translation = pivot + rotate(turn, view.room_from_eye.translation - pivot);
    return result;
}

Vec3 point_of_interest(const Calibration& calibration, DepthView depth) {
    std::vector<std::uint16_t> values;
    for (int y = depth.size.height / 3; y < depth.size.height * 2 / 3; y += 4)
        for (int x = depth.size.width / 3; x < depth.size.width * 2 / 3; x += 4)
            if (const std::uint16_t value = depth.row(y)[x])
                values.push_back(value);
    if (values.empty())
        return calibration.room_from_camera * Vec3{0, 0, 1};
    std::sort(values.begin(), values.end());
    const double reach = interest_depth_mm / calibration.depth_unit_mm;
    const std::size_t enough = values.size() / interest_share;
    double distance = values[values.size() / 2];
    for (std::size_t first = 0; first + enough < values.size(); ++first)
        if (values[first + enough] - values[first] <= reach) {
            distance = values[first + enough / 2];
            break;
        }
    return calibration.room_from_camera * Vec3{0, 0, distance * calibration.depth_unit_mm / 1000};
}

}  // namespace theatron::render
