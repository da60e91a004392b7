// SPDX-License-Identifier: Apache-2.0
// The landmarks of a photo, found by theatron-landmarks: a program of its own, so that this one
// needs neither dlib nor its model, which not everybody may use (docs/face.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/time.h"
#include "face/landmark_draft.h"
#include "image/view.h"

namespace theatron::enrol {

// Where Debian's package libdlib-data puts its model of 68 landmarks.
inline constexpr const char* usual_landmark_model =
    "/usr/share/dlib/shape_predictor_68_face_landmarks.dat";

struct FoundLandmarks {
    std::optional<face::Landmarks> landmarks_px;
    int faces = 0;             // in the photo, where one was looked for
    std::string problem;       // why there are none: one sentence that names no photo
    bool is_searched = false;  // false: nothing could be looked for
};

// From any thread.
class LandmarkFinder {
public:
    // Finds the program beside this one, or where it was installed with it.
    explicit LandmarkFinder(std::filesystem::path model = usual_landmark_model);
    // `patience`: for one photo.
    LandmarkFinder(std::filesystem::path program, std::filesystem::path model, Duration patience);

    // Why this machine finds none, with what to install; empty: it does.
    std::string problem() const;
    // The landmarks are those of the largest face. It takes about a second. The photo is not empty.
    FoundLandmarks find(ColorView photo) const;

private:
    std::filesystem::path program_, model_;
    Duration patience_;
};

}  // namespace theatron::enrol
