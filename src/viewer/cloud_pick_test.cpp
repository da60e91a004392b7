// SPDX-License-Identifier: Apache-2.0
#include "viewer/cloud_pick.h"

#include <gtest/gtest.h>

#include "image/image.h"

namespace theatron::viewer {
namespace {

// A wall at 2 m, and before its left half a box at 1.5 m, seen by a camera that looks along -z.
class CloudPick : public ::testing::Test {
protected:
    CloudPick() : depth(Size{160, 120}) {
        calibration.depth = pinhole(depth.size, 70);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x)
                depth.pixels[std::size_t(y) * 160 + std::size_t(x)] = x < 80 ? 1500 : 2000;
        calibration.room_from_camera = look_at({0, 1.5, 2}, {0, 1.5, 0}, {0, 1, 0});
        cameras = {{3, &calibration, depth.view()}};
    }
    std::optional<CloudPoint> pick(Vec3 from, Vec3 to) const {
        return pick_cloud(cameras, {from, to - from});
    }

    DepthImage depth;
    Calibration calibration;
    std::vector<CloudCamera> cameras;
};

TEST_F(CloudPick, FindsTheSurfaceFromAnotherSideAndItsNormal) {
    const auto wall = pick({0.5, 1.9, 1}, {0.4, 1.5, 0});
    ASSERT_TRUE(wall);
    EXPECT_NEAR(length(wall->place - Vec3{0.4, 1.5, 0}), 0, 0.002);
    EXPECT_NEAR(dot(wall->normal, {0, 0, 1}), 1, 1e-6);
    EXPECT_EQ(wall->measured.camera, 3u);
    EXPECT_NEAR(wall->measured.in_camera.z, 2, 0.002);
    EXPECT_NEAR(wall->measured.deviation_m, 0.0005 + 0.00025 * 4, 0.0001);
}

TEST_F(CloudPick, TheNearestSurfaceHidesOthersAndEdgesAreNone) {
    const auto box = pick({-0.4, 1.5, 3}, {-0.4, 1.5, 0});
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->place.z, 0.5, 0.002);
    // Behind the box's edge, where the camera saw nothing, and on to the wall.
    const auto behind = pick({-0.6, 1.5, 0.3}, {0.6, 1.5, -0.1});
    ASSERT_TRUE(behind);
    EXPECT_NEAR(behind->place.z, 0, 0.01);
    EXPECT_FALSE(pick({0.4, 1.5, 1}, {0.4, 1.5, 3}));
}

TEST_F(CloudPick, PixelsThatWereNotMeasuredAreNoSurface) {
    std::fill(depth.pixels.begin(), depth.pixels.end(), 0);
    EXPECT_FALSE(pick({0.5, 1.9, 1}, {0.4, 1.5, 0}));
}

TEST_F(CloudPick, TheNearerOfTwoCamerasSurfacesIsTaken) {
    DepthImage other(Size{160, 120});
    std::fill(other.pixels.begin(), other.pixels.end(), std::uint16_t(1200));
    cameras.push_back({4, &calibration, other.view()});
    EXPECT_EQ(pick({0, 1.5, 3}, {0.1, 1.5, 0})->measured.camera, 4u);
}

}  // namespace
}  // namespace theatron::viewer
