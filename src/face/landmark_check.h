// SPDX-License-Identifier: Apache-2.0
// Says why 68 landmarks cannot be those of a face in a photo. Pure.
//
// A usual face is laid onto them by the best similarity, and by the best one that mirrors it
// (least squares in the complex plane; Umeyama, IEEE PAMI 1991, for two dimensions).
#pragma once

#include <cstdint>
#include <optional>

#include "face/landmark_draft.h"
#include "image/view.h"

namespace theatron::face {

enum class LandmarkFault : std::uint8_t {
    outside,      // of the photo
    too_small,    // the face, for a texture
    upside_down,  // the chin is above the eyes
    exchanged,    // left and right
    no_face,      // they do not lie as on a face
};

// Landmarks may be outside of the photo by this share of its longer side: a chin, or a jaw that is
// marked roughly.
inline constexpr double outside_share = 0.1;
// From one end of the jaw to the other.
inline constexpr double least_face_px = 24;
// Root mean square from the usual face that is laid onto them, in widths of the face. Drawn persons
// that are turned by up to 35 degrees stay below half of it (landmark_check_test.cpp).
inline constexpr double most_unusual = 0.25;

// `usual`: usual_landmarks(). nullopt: they can be a face's.
std::optional<LandmarkFault> landmark_fault(const Landmarks& photo_px, const Landmarks& usual,
                                            Size photo);

// The root mean square that is compared with most_unusual; infinite for one single place.
double unusual_share(const Landmarks& photo_px, const Landmarks& usual);

}  // namespace theatron::face
