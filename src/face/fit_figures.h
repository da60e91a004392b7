// SPDX-License-Identifier: Apache-2.0
// How well a face is fitted: persons drawn from the model, and their landmarks as a camera would
// see them.
#pragma once

#include "face/face_fit.h"

namespace theatron::face {

struct DrawnPerson {
    std::vector<float> identity;
    Channels channels{};
    Pose camera_from_face;
    FacePhoto photo;
};

// The person of a seed, with landmarks off by `noise_px` in each direction. `photo`: which of their
// photos; each has a pose, an expression and a camera of its own.
DrawnPerson drawn_person(const MorphModel& model, std::uint64_t seed, double noise_px,
                         std::uint64_t photo = 0);

// The mean distance of the same vertices of two persons at rest, laid onto each other. One photo
// does not tell how large a head is: `fits_size` brings both to one size before.
double surface_error_mm(const MorphModel& model, std::span<const float> person,
                        std::span<const float> other, bool fits_size = false);

double turned_degrees(const Pose& a, const Pose& b);

// Means over `persons` with one frontal photo each, whose landmarks are off by 2 px.
struct FitFigures {
    double mean_error_mm = 0;
    double mean_face_error_mm = 0;  // of the model's mean person in place of the fitted one
    double shape_error_mm = 0, mean_face_shape_error_mm = 0;  // the same, brought to one size
    // The same photo, where the distance of the eyes is known to 1 mm (its deviation).
    double eyes_known_error_mm = 0;
    double pose_degrees = 0, worst_pose_degrees = 0, residual_px = 0;
    int refused = 0;
};
FitFigures fit_figures(const MorphModel& model, int persons, std::uint64_t seed);

}  // namespace theatron::face
