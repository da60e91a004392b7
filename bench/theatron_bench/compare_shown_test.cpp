// SPDX-License-Identifier: Apache-2.0
#include "compare_shown.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::bench {
namespace {

constexpr Rgb red{200, 0, 0}, blue{0, 0, 200};

ColorImage filled(Size size, Rgb color) {
    ColorImage picture(size);
    std::fill(picture.pixels.begin(), picture.pixels.end(), color);
    return picture;
}

// 80 pixels are 90 degrees wide.
CompareCamera camera_at(Vec3 place, Vec3 target, Rgb color) {
    CompareCamera camera;
    camera.calibration.depth = camera.calibration.color = pinhole({80, 40}, 90);
    camera.calibration.room_from_camera = look_at(place, target, {0, 1, 0});
    camera.last_exact = filled({80, 40}, color);
    return camera;
}

ArrivedCamera arrived_from(const CompareCamera& camera) {
    return {.calibration = camera.calibration, .color = {camera.last_exact}};
}

// Cameras 2 and 4 m from the point; both see it.
struct TwoCameras {
    Vec3 point{0, 0, 2};
    CompareCamera near = camera_at({0, 0, 0}, point, red), far = camera_at({0, 0, -2}, point, blue);
    std::vector<const CompareCamera*> cameras{&near, &far};
    std::vector<ArrivedCamera> arrived{arrived_from(near), arrived_from(far)};
};

TEST(CompareShown, PicturesOfAllHeightsStandBesideEachOther) {
    const ColorImage both = beside_each_other({filled({2, 3}, red), filled({1, 2}, blue)});
    EXPECT_EQ(both.size, (Size{3, 3}));
    EXPECT_EQ(both.view().row(2)[1], red);
    EXPECT_EQ(both.view().row(1)[2], blue);
    EXPECT_EQ(both.view().row(2)[2], (Rgb{}));
}

TEST(CompareShown, ACallOfTwoCamerasHasTheSecondPictureAndThePartOfEach) {
    const TwoCameras two;
    CompareMethod method;
    show_video(method, two.cameras, two.arrived, two.point, false);
    ASSERT_EQ(method.pictures.size(), 1u);
    EXPECT_EQ(method.pictures[0], two.far.last_exact);
    // 4 m and 8 m wide at the point.
    constexpr int width =
        int(close_up_width_m / 4 * 80 + 0.5) + int(close_up_width_m / 8 * 80 + 0.5);
    ASSERT_TRUE(method.close_up);
    EXPECT_EQ(method.close_up->picture.size.width, width);
    EXPECT_EQ(method.close_up->picture.view().row(0)[width - 1], blue);
}

TEST(CompareShown, ACameraThatDoesNotSeeThePointHasNoPart) {
    TwoCameras two;
    two.far.calibration.room_from_camera = look_at({0, 0, -2}, {0, 0, -4}, {0, 1, 0});
    CompareMethod method;
    show_video(method, two.cameras, two.arrived, two.point, false);
    ASSERT_TRUE(method.close_up);
    EXPECT_EQ(method.close_up->picture.size.width, int(close_up_width_m / 4 * 80 + 0.5));
}

TEST(CompareShown, SightsAreThoseOfTheColourCamera) {
    TwoCameras two;
    two.near.calibration.color_from_depth.translation = {0, 0, -0.5};
    two.arrived[1].point_grid_m = 0.005;
    const auto sights = sight_cameras(two.cameras, two.arrived, true);
    ASSERT_EQ(sights.size(), 2u);
    EXPECT_NEAR((sights[0].room_from_lens * Vec3{0, 0, 0}).z, 0.5, 1e-9);
    EXPECT_NEAR(sights[0].coarsest_mm_at_1m, 25, 1e-6);
    EXPECT_EQ(sights[1].grid_mm, 5);
    EXPECT_EQ(sight_cameras(two.cameras, two.arrived, false)[0].coarsest_mm_at_1m, 0);
}

TEST(CompareShown, AZoomedCameraShowsTheCloseUpAndNothingElse) {
    const CompareCamera camera = camera_at({0, 0, 0}, {0, 0, 2}, red);
    CompareMethod method;
    show_video(method, {&camera}, {arrived_from(camera)}, {0, 0, 2}, true);
    EXPECT_TRUE(method.pictures.empty());
    ASSERT_TRUE(method.close_up);
    EXPECT_EQ(method.close_up->picture.size, (Size{80, 40}));
}

}  // namespace
}  // namespace theatron::bench
