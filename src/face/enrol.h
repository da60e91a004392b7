// SPDX-License-Identifier: Apache-2.0
// From photos of a person to their own face. Pure; takes some seconds.
#pragma once

#include <optional>

#include "face/enrolled_face.h"
#include "face/face_fit.h"
#include "image/image.h"

namespace theatron::face {

struct EnrolPhoto {
    Emotion emotion = Emotion::neutral;
    ColorView picture;
    std::array<Vec2, landmark_count> landmarks_px{};
    double view_degrees = 65;  // that the camera saw along the longer side of the picture
};

struct Enrolment {
    EnrolledFace face;                                              // without textures
    std::array<std::optional<ColorImage>, emotion_count> textures;  // of the emotions with a photo
    FaceFit fit;            // photos in the order in which they were given
    double seen_share = 0;  // of the skin, by the neutral photo
    double eyes_apart_mm = 0;
};

// The photos are one of each emotion at most, and the first of them is the neutral one. nullopt:
// that is not so, or no face can be fitted (fit_face). Precondition: the model is small enough
// for enrolled_person().
std::optional<Enrolment> enrol(const MorphModel& model, std::span<const EnrolPhoto> photos,
                               std::optional<EyeDistance> eyes = std::nullopt);

}  // namespace theatron::face
