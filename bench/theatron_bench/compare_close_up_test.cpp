// SPDX-License-Identifier: Apache-2.0
#include "compare_close_up.h"

#include <gtest/gtest.h>

namespace theatron::bench {
namespace {

// At the room's origin, looking along z; 80 pixels are 90 degrees wide.
Calibration camera_at_origin() {
    Calibration c;
    c.depth = c.color = pinhole({80, 40}, 90);
    c.room_from_camera = look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
    return c;
}

TEST(CompareCloseUp, ThePartIsAsWideAsThePlaceInTheRoom) {
    // 2 m away the picture is 4 m wide.
    const auto part = part_around(camera_at_origin(), {80, 40}, {0, 0, 2}, 1);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->size, (Size{20, 10}));
    EXPECT_NEAR(part->x, 30, 1);
    EXPECT_NEAR(part->y, 15, 1);
}

TEST(CompareCloseUp, APictureOfAnotherSizeHasTheSamePart) {
    const auto part = part_around(camera_at_origin(), {160, 80}, {0, 0, 2}, 1);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->size, (Size{40, 20}));
}

TEST(CompareCloseUp, AtAnEdgeThePartLiesInThePicture) {
    for (const double x : {-1.95, 1.95}) {
        const auto part = part_around(camera_at_origin(), {80, 40}, {x, 0, 2}, 1);
        ASSERT_TRUE(part);
        EXPECT_EQ(part->size, (Size{20, 10}));
        EXPECT_TRUE(capture::lies_in(*part, {80, 40}));
    }
}

TEST(CompareCloseUp, WhatThePictureDoesNotShowHasNoPart) {
    const Calibration camera = camera_at_origin();
    EXPECT_FALSE(part_around(camera, {80, 40}, {0, 0, -2}, 1));   // behind the camera
    EXPECT_FALSE(part_around(camera, {80, 40}, {5, 0, 2}, 1));    // beside the picture
    EXPECT_FALSE(part_around(camera, {80, 40}, {0, 0, 2}, 4.5));  // wider than the picture
}

}  // namespace
}  // namespace theatron::bench
