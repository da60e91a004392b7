// SPDX-License-Identifier: Apache-2.0
#include "render/picture_quality.h"

#include <gtest/gtest.h>

namespace theatron::render {
namespace {

constexpr Size size{32, 24};

Image<std::uint8_t> everything() {
    Image<std::uint8_t> mask(size);
    mask.pixels.assign(mask.pixels.size(), 1);
    return mask;
}

ColorImage stripes(int bright) {
    ColorImage image(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto v = std::uint8_t(x / 3 % 2 ? bright : 40);
            image.view().row(y)[x] = {v, v, v};
        }
    return image;
}

// A board from column `left` on, 1 m away, before a wall.
DepthImage board(int left) {
    DepthImage depth(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            depth.view().row(y)[x] = x >= left ? 1000 : 2000;
    return depth;
}

TEST(PictureQuality, ADifferenceOfTenStepsIs28Decibels) {
    ColorImage a(size), b(size);
    for (Rgb& p : b.pixels)
        p = {10, 10, 10};
    SquaredError error;
    error.add(a.view(), b.view(), everything().view());
    EXPECT_NEAR(error.root_mean_square(), 10, 1e-9);
    EXPECT_NEAR(error.psnr_db(), 28.13, 0.01);
}

TEST(PictureQuality, OnlyTheMaskCounts) {
    ColorImage a(size), b(size);
    b.pixels[0] = {255, 255, 255};
    auto mask = everything();
    mask.pixels[0] = 0;
    SquaredError error;
    error.add(a.view(), b.view(), mask.view());
    EXPECT_EQ(error.psnr_db(), 99);
}

TEST(PictureQuality, SimilarityIsOneForEqualPicturesAndLowWithoutStructure) {
    Similarity same, flat;
    same.add(stripes(200).view(), stripes(200).view(), everything().view());
    flat.add(stripes(40).view(), stripes(200).view(), everything().view());
    EXPECT_NEAR(same.mean(), 1, 1e-9);
    EXPECT_LT(flat.mean(), 0.2);
}

TEST(PictureQuality, AShiftedOutlineIsOffByItsShift) {
    OutlineError error;
    error.add(board(13).view(), board(10).view(), everything().view());
    EXPECT_NEAR(error.mean_px(), 3, 1e-9);
}

TEST(PictureQuality, WhereTheWallShowsThroughThereIsAHole) {
    auto on_board = everything();
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < 16; ++x)
            on_board.view().row(y)[x] = 0;
    DepthImage drawn = board(16);
    for (int i = 0; i < 4; ++i)
        drawn.view().row(5)[20 + i] = std::uint16_t(i % 2 ? 2000 : 0);
    Holes holes;
    holes.add(drawn.view(), board(16).view(), on_board.view());
    // Two columns of the board are not counted: they lie too near to its outline.
    EXPECT_NEAR(holes.percent(), 100.0 * 4 / (14 * size.height), 1e-9);
}

}  // namespace
}  // namespace theatron::render
