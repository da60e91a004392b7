// SPDX-License-Identifier: Apache-2.0
// The place of a participant's own camera relative to the person in its picture, from one depth
// image. It assumes that this person is the nearest large surface and faces the camera.
//
// Pure functions, for any thread.
#pragma once

#include <optional>

#include "geometry/calibration.h"
#include "image/view.h"

namespace theatron::publish {

// Without a person in the picture, the eyes are assumed here on the camera's axis.
inline constexpr double usual_eye_distance_m = 0.8;

// The middle between the eyes in the depth camera's frame, in metres. `depth` has the size of
// calibration.depth. A registered calibration gives the vertical; otherwise it is the image's.
// nullopt if no surface from 0.25 to 2.5 m is large enough for a person.
std::optional<Vec3> find_eyes(DepthView depth, const Calibration& calibration);

// The pose of the depth camera in the person's frame (wire::CameraFrame::person).
Pose person_from_camera(const Calibration& calibration, std::optional<Vec3> eyes_in_camera);

}  // namespace theatron::publish
