// SPDX-License-Identifier: Apache-2.0
// From where, and through which window, a picture of the scene is drawn.
//
// The eye is a camera: x right, y down, z forward. Its field of view is given
// as the tangents of the four half angles, as headsets give theirs; it belongs
// to no picture size.
#pragma once

#include "geometry/calibration.h"
#include "geometry/vec.h"

namespace theatron::render {

struct CameraView {
    Pose room_from_eye;
    // x/z at the left and right edge of the picture, y/z at its top and bottom.
    double left = -1, right = 1, top = -1, bottom = 1;
    double near_m = 0.05, far_m = 100;
};

// The camera's own view for a picture of `picture` size. The drawn picture agrees with the
// camera's, pixel by pixel, but for its lens distortion. Where the pictures' proportions
// differ, the drawn one shows more at two sides and loses nothing.
CameraView view_of_camera(const CameraModel& camera, const Pose& room_from_camera, Size picture);

// A view from `eye` towards `target` with room's up up in the picture. `eye`
// must not lie straight above or below `target`.
CameraView view_towards(Vec3 eye, Vec3 target, double vertical_fov_degrees, Size picture);

// The view carried around `pivot` (room), which keeps its place in the picture:
// by `yaw` about the room's vertical, positive to the viewer's right, then by `pitch`
// over it, positive upwards.
CameraView orbited(const CameraView& view, Vec3 pivot, double yaw_degrees, double pitch_degrees);

// The point in the room that a viewer would turn around: straight ahead of the camera, at the
// distance of the nearest surface that fills a tenth of the middle of `depth`, so that a person
// before a wall is found in every frame. One metre ahead if nothing is measured there.
Vec3 point_of_interest(const Calibration& calibration, DepthView depth);

}  // namespace theatron::render
