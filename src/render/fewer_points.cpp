// SPDX-License-Identifier: Apache-2.0
#include "render/fewer_points.h"

#include <algorithm>

namespace theatron::render {
namespace {

Size every_nth(Size size, int n) {
    return {(size.width + n - 1) / n, (size.height + n - 1) / n};
}

std::uint16_t first_measured(DepthView depth, int left, int top, int n) {
    for (int y = top; y < std::min(top + n, depth.size.height); ++y)
        for (int x = left; x < std::min(left + n, depth.size.width); ++x)
            if (depth.row(y)[x] != 0)
                return depth.row(y)[x];
    return 0;
}

}  // namespace

// Pixels are counted by their middles, so that the n-th becomes the first.
CameraModel every_nth(CameraModel camera, int n) {
    camera.size = every_nth(camera.size, n);
    camera.fx /= n;
    camera.fy /= n;
    camera.cx /= n;
    camera.cy /= n;
    return camera;
}

DepthImage every_nth(DepthView depth, int n) {
    DepthImage fewer(every_nth(depth.size, n));
    for (int y = 0; y < fewer.size.height; ++y)
        for (int x = 0; x < fewer.size.width; ++x)
            fewer.view().row(y)[x] = first_measured(depth, x * n, y * n, n);
    return fewer;
}

}  // namespace theatron::render
