// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "viewer/head_text.h"

namespace theatron::viewer {

std::string nothing_seen(const SeenPerson& person, const Calibration& calibration,
                         DepthView depth) {
    const auto ball = person.cut().keep;
    // A person covers many pixels: every fourth one is enough.
    constexpr int apart = 4;
    for (int y = 0; y < depth.size.height; y += apart)
        for (int x = 0; x < depth.size.width; x += apart) {
            const double z = depth_m(calibration, depth.row(y)[x]);
            const auto ray =
                z > 0 ? unproject(calibration.depth, {double(x), double(y)}) : std::nullopt;
            if (ray && length(calibration.room_from_camera * Vec3{ray->x * z, ray->y * z, z} -
                              ball->middle) < ball->radius_m)
                return "";
        }
    const Vec3 head = person.room_from_head.translation,
               camera = calibration.room_from_camera.translation;
    char text[240];
    std::snprintf(text, sizeof(text),
                  "Camera %.64s sees nothing within %.3g m of the person with the head at "
                  "%.2f:%.2f:%.2f, so nothing of it is drawn; the camera stands at "
                  "%.2f:%.2f:%.2f.",
                  person.camera.c_str(), person.reach_m, head.x, head.y, head.z, camera.x, camera.y,
                  camera.z);
    return text;
}

}  // namespace theatron::viewer
