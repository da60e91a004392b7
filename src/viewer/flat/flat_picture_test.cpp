// SPDX-License-Identifier: Apache-2.0
#include "viewer/flat/flat_picture.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/image.h"

namespace theatron::viewer {
namespace {

// A wall at z 0, seen from z 2 by a depth camera that has its colour camera 5 cm beside it.
class FlatPictureTest : public ::testing::Test {
protected:
    FlatPictureTest() : depth(Size{160, 120}) {
        std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(2000));
        calibration.depth = pinhole(depth.size, 70);
        calibration.color = pinhole({320, 180}, 60);
        calibration.color_from_depth = {{}, {0.05, 0, 0}};
        calibration.room_from_camera = look_at({0, 1.5, 2}, {0, 1.5, 0}, {0, 1, 0});
    }
    FlatPicture picture() const { return {CameraId{3}, calibration, depth.view()}; }

    DepthImage depth;
    Calibration calibration;
};

TEST_F(FlatPictureTest, ThePlaceOfASurfaceIsSeenWhereItsRayWent) {
    const FlatPicture seen = picture();
    EXPECT_TRUE(seen.has_surface());
    EXPECT_DOUBLE_EQ(seen.aspect(), 320.0 / 180);
    for (const Vec2 place : {Vec2{0.5, 0.5}, Vec2{0.2, 0.3}, Vec2{0.9, 0.8}}) {
        const auto ray = seen.ray_through(place);
        ASSERT_TRUE(ray);
        const auto point = seen.surface_at(*ray);
        ASSERT_TRUE(point);
        EXPECT_NEAR(point->place.z, 0, 0.002);
        EXPECT_EQ(point->measured.camera, 3u);
        const auto back = seen.seen_at(point->place);
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->place.x, place.x, 1e-6);
        EXPECT_NEAR(back->place.y, place.y, 1e-6);
        EXPECT_NEAR(back->heights_per_m, calibration.color.fy / (2 * 180), 1e-3);
    }
}

TEST_F(FlatPictureTest, WhatIsBehindOrFarBesideIsSeenNowhere) {
    EXPECT_FALSE(picture().seen_at({0, 1.5, 3}));
    EXPECT_FALSE(picture().seen_at({50, 1.5, 0}));
}

TEST_F(FlatPictureTest, DepthThatDoesNotFitIsNone) {
    const DepthImage other(Size{80, 60});
    const FlatPicture seen{CameraId{3}, calibration, other.view()};
    EXPECT_FALSE(seen.has_surface());
    EXPECT_FALSE(seen.surface_at(*seen.ray_through({0.5, 0.5})));
    EXPECT_FALSE(FlatPicture(CameraId{3}, calibration, {}).has_surface());
}

}  // namespace
}  // namespace theatron::viewer
