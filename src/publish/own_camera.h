// SPDX-License-Identifier: Apache-2.0
// The place of a participant's own camera relative to the person in its picture, from one depth
// image: from the head in it (registration/head_finder.h). Where none shows clearly, the person is
// assumed to be the nearest large surface. The person faces the camera.
//
// Pure functions, for any thread.
#pragma once

#include <optional>

#include "geometry/calibration.h"
#include "image/view.h"

namespace theatron::publish {

// Without a person in the picture, the eyes are assumed here on the camera's axis.
inline constexpr double usual_eye_distance_m = 0.8;

struct Eyes {
    Vec3 middle;           // between the eyes, depth camera's frame, metres
    bool of_head = false;  // from a head; else from the nearest surface
};

// `depth` has the size of calibration.depth. A registered calibration gives the vertical; otherwise
// it is the image's. nullopt if there is no head from 0.4 to 2.5 m, nor a surface from 0.25 to
// 2.5 m that is large enough for a person.
std::optional<Eyes> find_eyes(DepthView depth, const Calibration& calibration);

// The pose of the depth camera in the person's frame (wire::CameraKind::person).
Pose person_from_camera(const Calibration& calibration, std::optional<Vec3> eyes_in_camera);

}  // namespace theatron::publish
