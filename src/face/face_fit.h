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
    // The expression that the person was asked for; at rest where nothing is said. A face that
    // shows much more than expected would be taken for a smaller head that is nearer.
    Channels expected{};
};

// How far apart the pupils are, as a headset's setting or an optician says. One photo does not tell
// how large a head is; this does.
struct EyeDistance {
    double mm = 0;
    double sigma_mm = 1;
};
inline constexpr double least_eye_distance_mm = 45, most_eye_distance_mm = 80;

struct FaceFit {
    std::vector<float> identity;  // in standard deviations
    struct Photo {
        Pose camera_from_face;  // millimetres; camera: x right, y down, z forward
        Channels channels{};
        double residual_px = 0;  // root mean square of its landmarks
    };
    std::vector<Photo> photos;
    double residual_px = 0;  // root mean square of all landmarks
};

inline constexpr std::size_t max_photos = 12;

// From the middle of one eye's landmarks to that of the other, at rest.
double eye_distance_mm(const MorphModel& model, std::span<const float> identity);

// nullopt if there is no photo, more than max_photos, or a landmark or a focal length that is not
// finite and positive, or landmarks that lie on one point, or a distance of the eyes that nobody
// has.
std::optional<FaceFit> fit_face(const MorphModel& model, std::span<const FacePhoto> photos,
                                std::optional<EyeDistance> eyes = std::nullopt);

// Landmarks of a .pts file as iBUG writes them: "n_points: 68", then a pair of numbers a line
// between braces. Safe on any text.
Result<std::array<Vec2, landmark_count>> parse_pts(std::string_view text);

}  // namespace theatron::face
