// SPDX-License-Identifier: Apache-2.0
// The picture of the window below its texts: the photo, and the landmarks on it. Pure.
#pragma once

#include <optional>

#include "enrol/photo_place.h"
#include "face/landmark_draft.h"
#include "image/image.h"

namespace theatron::enrol {

inline constexpr Rgb canvas_ground{24, 26, 30};
inline constexpr Rgb landmark_color{90, 235, 255}, chosen_color{255, 200, 70};

// Fills `canvas`, whose size is that of the window; `mirrored`: left and right change their places
// within the photo, as in a mirror.
void draw_photo(ColorView photo, const PhotoPlace& place, bool mirrored, MutableColorView canvas);

// Lines and points of the landmarks that are shown. `dot_px` is a point's radius.
void draw_landmarks(const face::LandmarkDraft& draft, std::optional<std::size_t> chosen,
                    const PhotoPlace& place, double dot_px, MutableColorView canvas);

// The cross of PhotoGuide::cross_px(), in pixels of the window.
void draw_cross(Vec2 at, double size_px, MutableColorView canvas);

}  // namespace theatron::enrol
