// SPDX-License-Identifier: Apache-2.0
// Photos of persons who do not exist, with their truth: for tests, and to try what needs photos.
// Pure.
#pragma once

#include "face/emotion.h"
#include "face/face_fit.h"
#include "face/face_picture.h"

namespace theatron::face {

struct PaintedPerson {
    std::vector<float> identity;
    ColorImage texture;  // of the skin, texture_side pixels a side
};

// The person of a seed: skin, brows, lips and moles, painted round the model's landmarks. A model
// whose skin covers the eyes gets painted ones.
PaintedPerson painted_person(const MorphModel& model, std::uint64_t seed);

struct PaintedPhoto {
    ColorImage picture;
    FaceCamera camera;
    Channels channels{};
    std::array<Vec2, landmark_count> landmarks_px{};
};

// A photo of the person with this emotion, nearly frontal, by a lamp and with a brightness of its
// own. `view_degrees` is what the camera sees along the longer side of the picture.
PaintedPhoto painted_photo(const MorphModel& model, const PaintedPerson& person, Emotion emotion,
                           std::uint64_t seed, Size size, double view_degrees, double noise_px = 0);

}  // namespace theatron::face
