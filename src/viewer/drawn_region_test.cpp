// SPDX-License-Identifier: Apache-2.0
#include "viewer/drawn_region.h"

#include <gtest/gtest.h>

#include "image/image.h"

namespace theatron::viewer {
namespace {

// A wall at 2 m, and before its right half a board at 1 m.
class Region : public ::testing::Test {
protected:
    Region() {
        calibration.depth.size = {160, 120};
        calibration.depth.fx = calibration.depth.fy = 130;
        calibration.depth.cx = 79.5;
        calibration.depth.cy = 59.5;
        depth.resize(calibration.depth.size);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x)
                depth.view().row(y)[x] = std::uint16_t(x < 80 ? 2000 : 1000);
    }
    std::optional<session::PictureBox> drawn(Vec2 from, Vec2 to, const render::CameraView& view) {
        return drawn_region({from, to}, view, {0, &calibration, std::as_const(depth).view()});
    }

    Calibration calibration;
    DepthImage depth;
};

TEST_F(Region, FromTheCamerasOwnViewIsTheRectangle) {
    const auto view =
        render::view_of_camera(calibration.depth, calibration.room_from_camera, {160, 120});
    const auto box = drawn({0.75, 0.75}, {0.25, 0.5}, view);
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->x, 40, 1);
    EXPECT_NEAR(box->y, 60, 1);
    EXPECT_NEAR(box->width, 80, 2);
    EXPECT_NEAR(box->height, 30, 2);
    EXPECT_FALSE(drawn({0.5, 0.5}, {0.5, 0.9}, view)) << "no area";
    EXPECT_FALSE(drawn({0.5, 0.5}, {0.52, 0.52}, view)) << "hardly a pixel";
}

TEST_F(Region, DoesNotReachTheSurfaceBehind) {
    // From the right, where the board hides a part of the wall that the camera sees.
    render::CameraView view =
        render::view_of_camera(calibration.depth, calibration.room_from_camera, {160, 120});
    view.room_from_eye = view.room_from_eye * Pose{{}, {0.5, 0, 0}};
    // The board reaches from 0.094 to 0.59 of the view's width, and hides the wall up to 0.297.
    const auto board = drawn({0.12, 0.3}, {0.45, 0.6}, view);
    ASSERT_TRUE(board);
    EXPECT_GE(board->x, 80);
    EXPECT_FALSE(drawn({0.9, 0.1}, {1, 0.9}, view)) << "it sees nothing there";
}

}  // namespace
}  // namespace theatron::viewer
