// SPDX-License-Identifier: Apache-2.0
// The colour of a person's skin in the picture of their own camera, so that a face that is drawn
// into their cloud is as bright as the neck below it. Pure.
#pragma once

#include <optional>

#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/view.h"

namespace theatron::viewer {

// Linear, from points of the neck that look like skin; nullopt: too few of them are seen.
// `calibration` is in the person's frame (wire::CameraKind::person), its colour camera has the
// size of `color`; `rays` are those of its depth camera.
std::optional<Vec3> cloud_skin(DepthView depth, ColorView color, const Calibration& calibration,
                               const Image<Ray>& rays);

// Factors of the colours of a face with which its skin is like that of the cloud;
// within limits, since a lamp or a scarf is no skin.
Vec3 skin_gain(Vec3 face_skin, Vec3 cloud_skin);

}  // namespace theatron::viewer
