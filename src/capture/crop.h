// SPDX-License-Identifier: Apache-2.0
// Crops of pictures, and the matching camera model, which is exact: a crop only moves the
// principal point.
#pragma once

#include <optional>
#include <string_view>

#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron::capture {

// A rectangle of a picture: top left pixel and size.
struct Crop {
    int x = 0, y = 0;
    Size size;
    bool operator==(const Crop&) const = default;
};

// Parses "X:Y:WxH", or "WxH". Nullopt if the text has another form.
std::optional<Crop> parse_crop(std::string_view text);
std::optional<Size> parse_size(std::string_view text);

// True if the rectangle is inside a picture of this size.
bool lies_in(const Crop& crop, Size whole);

CameraModel cropped(CameraModel camera, const Crop& crop);

template <class T>
View<const T> part_of(View<const T> image, const Crop& crop) {
    return {image.row(crop.y) + crop.x, crop.size, image.stride};
}

// The part of the colour picture that the depth camera sees, at all distances from `near_m` to
// `far_m`; empty if there is none.
Crop color_seen_by_depth(const Calibration& calibration, double near_m, double far_m);

// Scales down: each pixel is the mean of the area that it covers. `out` is at most as large as
// `image` in both dimensions.
void scale_by_area(ColorView image, MutableColorView out);

}  // namespace theatron::capture
