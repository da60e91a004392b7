// SPDX-License-Identifier: Apache-2.0
#include "geometry/screen.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

const Pose place{rotation_about({0, 1, 0}, 0.4) * Quat{0, 1, 0, 0}, {1, 1.5, -2}};

TEST(ScreenTest, AScreenKeepsItsPlaceAndShapeAsACalibration) {
    const auto read =
        decode_calibration(encode_calibration(screen_calibration({1920, 1080}, 1.6, place)));
    ASSERT_TRUE(read);
    EXPECT_TRUE(is_screen(*read));
    const ScreenPlace screen = screen_place(*read);
    EXPECT_NEAR(screen.width_m, 1.6, 1e-9);
    EXPECT_NEAR(screen.height_m, 0.9, 1e-9);
    EXPECT_NEAR(length(screen.room_from_screen.translation - place.translation), 0, 1e-9);
}

// So a viewer that draws any camera as a cloud shows the picture in the same place.
TEST(ScreenTest, TheOuterPointsOfItsCloudAreTheCornersOfThePicture) {
    const Calibration c = screen_calibration({640, 480}, 0.8, place);
    const ScreenPlace screen = screen_place(c);
    const double z = screen_distance_mm / 1000.0;
    const Vec3 corner =
        c.room_from_camera * Vec3{-c.depth.cx / c.depth.fx * z, -c.depth.cy / c.depth.fy * z, z};
    EXPECT_NEAR(length(corner - screen.room_from_screen * Vec3{-0.4, -0.3, 0}), 0, 1e-9);
    const auto pixel = project(c.color, {-0.4, -0.3, z});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, -0.5, 1e-6);
    EXPECT_NEAR(pixel->y, -0.5, 1e-6);
}

TEST(ScreenTest, AnOrdinaryCameraIsNoScreen) {
    Calibration c = screen_calibration({640, 480}, 0.8, place);
    c.depth.size = {320, 288};
    EXPECT_FALSE(is_screen(c));
}

}  // namespace
}  // namespace theatron
