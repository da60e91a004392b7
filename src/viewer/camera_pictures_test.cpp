// SPDX-License-Identifier: Apache-2.0
#include "viewer/camera_pictures.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

constexpr Size size{8, 4};

// Colour and depth cameras at the same place.
Calibration calibration() {
    Calibration calibration;
    calibration.depth = calibration.color = pinhole(size, 70);
    return calibration;
}

DepthImage depth_of(std::uint16_t left_mm, std::uint16_t right_mm) {
    DepthImage depth(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            depth.view().row(y)[x] = x < size.width / 2 ? left_mm : right_mm;
    return depth;
}

int brightness(Rgb c) {
    return c.r + c.g + c.b;
}

TEST(CameraPictures, NearerIsBrighterAndTheEndsHaveTheFirstAndTheLastColour) {
    for (int i = 0; i < 20; ++i)
        EXPECT_GT(brightness(depth_color(i / 20.0)), brightness(depth_color((i + 1) / 20.0)));
    EXPECT_EQ(depth_color(-3), depth_color(0));
    EXPECT_EQ(depth_color(7), depth_color(1));
}

TEST(CameraPictures, TheRangeEndsAtQuartersOfAMetre) {
    EXPECT_EQ(depth_range(calibration(), depth_of(1100, 2300).view()), (DepthRange{1.0, 2.5}));
    EXPECT_EQ(depth_range(calibration(), depth_of(0, 0).view()), std::nullopt);
}

TEST(CameraPictures, DepthThatWasNotMeasuredIsBlack) {
    const ColorImage picture =
        depth_picture(calibration(), depth_of(0, 1500).view(), size, {1.0, 2.0});
    EXPECT_EQ(picture.view().row(1)[0], (Rgb{}));
    EXPECT_EQ(picture.view().row(1)[7], depth_color(0.5));
}

TEST(CameraPictures, BothHaveHalfOfTheColourThatTheColourCameraHasForThePoint) {
    ColorImage color(Size{16, 8});  // a scaled picture
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
            color.view().row(y)[x] = x < 8 ? Rgb{200, 0, 0} : Rgb{0, 0, 200};
    const Calibration lens = calibration();
    const ColorImage picture =
        blended_picture(lens, depth_of(1000, 1000).view(), make_ray_table(lens.depth), color.view(),
                        size, {1.0, 2.0});
    const Rgb near = depth_color(0);
    EXPECT_EQ(picture.view().row(2)[1].r, (near.r + 200) / 2);
    EXPECT_EQ(picture.view().row(2)[1].b, near.b / 2);
    EXPECT_EQ(picture.view().row(2)[6].b, (near.b + 200) / 2);
}

TEST(CameraPictures, ASmallerPictureHasTheMeansOfThePixels) {
    ColorImage color(Size{4, 2});
    for (int x = 0; x < 4; ++x) {
        color.view().row(0)[x] = {100, 0, 0};
        color.view().row(1)[x] = {200, 40, 0};
    }
    const ColorImage picture = reduced(color.view(), fitted(color.size, 2));
    ASSERT_EQ(picture.size, (Size{2, 1}));
    EXPECT_EQ(picture.view().row(0)[1], (Rgb{150, 20, 0}));
}

TEST(CameraPictures, ARangeBecomesOnlyWiderAndTheSameFrameIsNotComputedAgain) {
    CameraPictures pictures;
    const auto of = [&](std::uint64_t number, const DepthImage& depth) {
        return pictures.of(CameraId(1), number, calibration(), depth.view(), nullptr, 320);
    };
    const auto first = of(1, depth_of(600, 3100));
    EXPECT_EQ(first.range, (DepthRange{0.5, 3.25}));
    EXPECT_EQ(of(1, depth_of(600, 3100)).depth, first.depth);
    EXPECT_EQ(of(2, depth_of(1100, 2300)).range, first.range);
    EXPECT_EQ(of(3, depth_of(1100, 4000)).range, (DepthRange{0.5, 4.25}));
    EXPECT_FALSE(first.color || first.blended);
}

}  // namespace
}  // namespace theatron::viewer
