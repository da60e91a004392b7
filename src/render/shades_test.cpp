// SPDX-License-Identifier: Apache-2.0
#include "render/shades.h"

#include <gtest/gtest.h>

#include <cmath>

namespace theatron::render {
namespace {

Calibration depth_alone(Size size) {
    Calibration calibration;
    calibration.depth = pinhole(size, 60);
    return calibration;
}

// The grey at the middle of a plane through (0, 0, 1 m) whose depth grows by `right` and `below`
// per metre.
int grey_of_plane(double right, double below) {
    const Calibration calibration = depth_alone({97, 73});
    const CameraModel& lens = calibration.depth;
    DepthImage depth(lens.size);
    for (int y = 0; y < lens.size.height; ++y)
        for (int x = 0; x < lens.size.width; ++x)
            depth.view().row(y)[x] = std::uint16_t(
                1000 / (1 - right * (x - lens.cx) / lens.fx - below * (y - lens.cy) / lens.fy) +
                0.5);
    ColorImage shades;
    shade(depth.view(), calibration, shades);
    EXPECT_EQ(shades.size, (Size{49, 37}));
    return shades.view().row(18)[24].r;
}

TEST(Shades, GrowWithTheTurnTowardsTheLight) {
    const int facing = grey_of_plane(0, 0);
    EXPECT_NEAR(facing, 40 + 160 * 0.8, 2);
    // Turned upwards: its lower part is nearer. Turned downwards: its upper part is.
    const int upwards = grey_of_plane(0, -1), downwards = grey_of_plane(0, 1);
    EXPECT_NEAR(upwards, 40 + 160 * (0.48 + 0.8) / std::sqrt(2.0), 4);
    EXPECT_NEAR(downwards, 40 + 160 * (0.8 - 0.48) / std::sqrt(2.0), 4);
    EXPECT_GT(grey_of_plane(-0.5, 0), facing);  // turned left
    EXPECT_LT(grey_of_plane(0.5, 0), facing);
}

TEST(Shades, DoNotBendAtTheBorderOfAnObject) {
    const Calibration calibration = depth_alone({96, 72});
    DepthImage depth(calibration.depth.size);
    for (int y = 0; y < 72; ++y)
        for (int x = 0; x < 96; ++x)
            depth.view().row(y)[x] = y < 8 ? 0 : x < 48 ? 800 : 1500;
    ColorImage shades;
    shade(depth.view(), calibration, shades);
    const Rgb facing = shades.view().row(20)[10];
    for (const Rgb& one : shades.pixels)
        EXPECT_EQ(one, facing);
}

}  // namespace
}  // namespace theatron::render
