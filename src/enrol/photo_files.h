// SPDX-License-Identifier: Apache-2.0
// Files of photos and of their landmarks.
#pragma once

#include <string>

#include "face/landmark_draft.h"
#include "image/image.h"

namespace theatron::enrol {

// JPEG or PNG. Throws Error, with a sentence that repeats nothing of the file's content; so does
// the next.
ColorImage read_photo(const std::string& file);
// The landmarks of a .pts file, for a photo of this size. Such that cannot be a face's are refused
// (face/landmark_check.h, with its `usual`).
face::Landmarks read_landmarks(const std::string& file, Size photo, const face::Landmarks& usual);

std::string pts_text(const face::Landmarks& landmarks_px);

}  // namespace theatron::enrol
