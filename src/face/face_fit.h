// SPDX-License-Identifier: Apache-2.0
// A morphable head fitted to the 68 landmarks of one photo or several of one person.
//
// Pose, expression and the person's shape together, by Levenberg and Marquardt's method; shapes
// that are rare cost as much as their rarity (the prior of the model). The contour of the jaw is
// where the head turns away from the camera, so its points count less; photos should be frontal.
#pragma once

#include <optional>

#include "face/morph_model.h"

namespace theatron::face {

struct FacePhoto {
    std::array<Vec2, landmark_count> landmarks_px{};
    double focal_px = 0;  // of a camera without distortion
    Vec2 centre_px;       // its principal point
};

struct FaceFit {
    std::vector<float> identity;  // in standard deviations
    struct Photo {
        Pose camera_from_face;  // millimetres; camera: x right, y down, z forward
        Channels channels{};
    };
    std::vector<Photo> photos;
    double residual_px = 0;  // root mean square of all landmarks
};

inline constexpr std::size_t max_photos = 12;

// nullopt if there is no photo, more than max_photos, or a landmark or a focal length that is not
// finite and positive, or landmarks that lie on one point.
std::optional<FaceFit> fit_face(const MorphModel& model, std::span<const FacePhoto> photos);

// Landmarks of a .pts file as iBUG writes them: "n_points: 68", then a pair of numbers a line
// between braces. Safe on any text.
Result<std::array<Vec2, landmark_count>> parse_pts(std::string_view text);

}  // namespace theatron::face
