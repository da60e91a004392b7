// SPDX-License-Identifier: Apache-2.0
// Parts of pictures, and what becomes of the camera model: exact, because a crop
// moves the principal point and nothing else.
#pragma once

#include <optional>
#include <string_view>

#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron::capture {

// A part of a picture: the top left pixel and the size.
struct Crop {
    int x = 0, y = 0;
    Size size;
    bool operator==(const Crop&) const = default;
};

// Reads "X:Y:WxH", or "WxH". Nothing if it is not of this form.
std::optional<Crop> parse_crop(std::string_view text);
std::optional<Size> parse_size(std::string_view text);

// True if the part lies in a picture of this size.
bool lies_in(const Crop& crop, Size whole);

CameraModel cropped(CameraModel camera, const Crop& crop);

template <class T>
View<const T> part_of(View<const T> image, const Crop& crop) {
    return {image.row(crop.y) + crop.x, crop.size, image.stride};
}

// The part of the colour picture that the depth camera can see, at any distance
// from `near_m` to `far_m`; empty if there is none.
Crop color_seen_by_depth(const Calibration& calibration, double near_m, double far_m);

// Scales down: each pixel is the mean of what it covers. `out` is at most as
// large as `image` on both sides.
void scale_by_area(ColorView image, MutableColorView out);

}  // namespace theatron::capture
