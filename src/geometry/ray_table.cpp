// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray_table.h"

namespace theatron {

Image<Ray> make_ray_table(const CameraModel& camera) {
    Image<Ray> table(camera.size);
    for (int y = 0; y < camera.size.height; ++y)
        for (int x = 0; x < camera.size.width; ++x) {
            const auto direction = unproject(camera, {double(x), double(y)});
            table.view().row(y)[x] =
                direction ? Ray{float(direction->x), float(direction->y)} : Ray{no_ray, no_ray};
        }
    return table;
}

}  // namespace theatron
