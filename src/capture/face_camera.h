// SPDX-License-Identifier: Apache-2.0
// The picture of a person's face, from an ordinary camera: a small screen (geometry/screen.h) that
// is drawn on the person's head in the room (wire::CameraKind::face).
#pragma once

#include <string>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* face_camera_help =
    "face:DEVICE  a small picture, as of theatron join --webcam: /dev/video0, a video file, or "
    "test for a generated picture";

inline constexpr Size face_picture{320, 240};
inline constexpr double face_fps = 15;

// The camera behind a webcam's name, with its own pictures: `device` as in face_camera_help, but
// for "test".
std::string webcam_specification(std::string device, Size size = {1280, 720});

// Pictures of the device's middle, scaled, at most face_fps.
std::unique_ptr<Camera> open_face_camera(Options& options, const Progress& progress);

// The same of any camera that gives pixels, for tests.
std::unique_ptr<Camera> make_face_camera(std::unique_ptr<Camera> camera);

// Fills `out` with the middle of `picture`, as much of it as has out's shape. Each pixel is the
// mean of those that it covers, or the nearest one of a smaller picture. Neither view is empty.
void fit_middle(ColorView picture, MutableColorView out);

// The generated picture: red on the left, blue on the right, and a white disc with a hand that goes
// round, 15 steps in a second.
void draw_test_face(FrameNumber number, MutableColorView out);

}  // namespace theatron::capture
