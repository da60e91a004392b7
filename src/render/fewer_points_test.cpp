// SPDX-License-Identifier: Apache-2.0
#include "render/fewer_points.h"

#include <gtest/gtest.h>

namespace theatron::render {
namespace {

TEST(FewerPoints, EverySecondPixelOfEverySecondRowIsKept) {
    DepthImage depth({5, 3});
    depth.pixels = {11, 12, 13, 14, 15, 21, 22, 23, 24, 25, 31, 32, 33, 34, 35};
    const DepthImage fewer = every_nth(depth.view(), 2);
    EXPECT_EQ(fewer.size, (Size{3, 2}));
    EXPECT_EQ(fewer.pixels, (std::vector<std::uint16_t>{11, 13, 15, 31, 33, 35}));
    EXPECT_EQ(every_nth(depth.view(), 1).pixels, depth.pixels);
}

TEST(FewerPoints, AHoleStaysOnlyWhereNothingWasMeasuredAround) {
    DepthImage depth({4, 3});
    depth.pixels = {0, 12, 0, 0, 21, 22, 0, 0, 0, 32, 0, 0};
    EXPECT_EQ(every_nth(depth.view(), 2).pixels, (std::vector<std::uint16_t>{12, 0, 32, 0}));
}

TEST(FewerPoints, ThePixelsSeeAlongTheSameRays) {
    CameraModel lens = pinhole({96, 71}, 60);
    lens.k = {0.2, -0.05, 0.01, 0.1, 0.02, 0};
    lens.p1 = 0.001;
    const CameraModel fewer = every_nth(lens, 3);
    EXPECT_EQ(fewer.size, (Size{32, 24}));
    for (const Vec2 pixel : {Vec2{0, 0}, Vec2{10, 20}, Vec2{31, 23}}) {
        const Vec2 a = unproject(fewer, pixel).value();
        const Vec2 b = unproject(lens, {pixel.x * 3, pixel.y * 3}).value();
        EXPECT_NEAR(a.x, b.x, 1e-9);
        EXPECT_NEAR(a.y, b.y, 1e-9);
    }
}

}  // namespace
}  // namespace theatron::render
