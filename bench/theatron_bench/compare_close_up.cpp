// SPDX-License-Identifier: Apache-2.0
#include "compare_close_up.h"

#include <algorithm>
#include <cmath>

namespace theatron::bench {

std::optional<capture::Crop> part_around(const Calibration& calibration, Size picture,
                                         Vec3 point_room, double width_m) {
    const CameraModel camera = scaled(calibration.color, picture);
    const Vec3 middle =
        calibration.color_from_depth * (inverse(calibration.room_from_camera) * point_room);
    const Vec3 aside{width_m / 2, 0, 0};
    const auto place = project(camera, middle), left = project(camera, middle - aside),
               right = project(camera, middle + aside);
    if (!place || !left || !right || place->x < 0 || place->y < 0 || place->x >= picture.width ||
        place->y >= picture.height)
        return std::nullopt;
    const double width = right->x - left->x;
    const Size size{int(std::lround(width)),
                    int(std::lround(width * picture.height / picture.width))};
    if (size.width < 1 || size.height < 1 || size.width > picture.width ||
        size.height > picture.height)
        return std::nullopt;
    const auto begin = [](double middle_px, int part, int whole) {
        return std::clamp(int(std::lround(middle_px - part / 2.0)), 0, whole - part);
    };
    return capture::Crop{begin(place->x, size.width, picture.width),
                         begin(place->y, size.height, picture.height), size};
}

}  // namespace theatron::bench
