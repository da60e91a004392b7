// SPDX-License-Identifier: Apache-2.0
#include "compare_points.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace theatron::bench {
namespace {

Calibration flat_camera() {
    Calibration c;
    c.depth = c.color = pinhole({4, 4}, 90);
    c.room_from_camera = look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
    return c;
}

PointCloud seen_cloud(const DepthImage& depth, const ColorImage& color,
                      const Image<std::uint8_t>& seen) {
    const Calibration camera = flat_camera();
    return cloud_of(camera, make_ray_table(camera.depth), depth.view(), color.view(), seen.view());
}

TEST(ComparePoints, PixelsWithDepthAndColourBecomePoints) {
    DepthImage depth({4, 4});
    ColorImage color({4, 4});
    Image<std::uint8_t> seen({4, 4});
    depth.pixels[5] = 2000;
    depth.pixels[6] = 2000;                 // without colour
    seen.pixels[5] = seen.pixels[7] = 255;  // the second without depth
    color.pixels[5] = {1, 2, 3};
    const PointCloud cloud = seen_cloud(depth, color, seen);
    ASSERT_EQ(cloud.size(), 1u);
    EXPECT_FLOAT_EQ(cloud[0].z, 2);
    EXPECT_LT(cloud[0].x, 0);  // left of the middle, and above it
    EXPECT_LT(cloud[0].y, 0);
    EXPECT_EQ((Rgb{cloud[0].r, cloud[0].g, cloud[0].b}), (Rgb{1, 2, 3}));
}

TEST(ComparePoints, ThePictureShowsThePixelsAgain) {
    DepthImage depth({4, 4});
    ColorImage color({4, 4});
    Image<std::uint8_t> seen({4, 4});
    for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
        depth.pixels[i] = std::uint16_t(1000 + 10 * i);
        color.pixels[i] = {std::uint8_t(i), 0, 0};
        seen.pixels[i] = 255;
    }
    const Calibration camera = flat_camera();
    const PointCloud cloud = seen_cloud(depth, color, seen);
    const auto picture = draw_points(
        {{&cloud, camera.room_from_camera}},
        render::view_of_camera(camera.depth, camera.room_from_camera, {4, 4}), {4, 4}, 0.001);
    EXPECT_EQ(picture.color, color);
    EXPECT_EQ(picture.depth_mm, depth);
}

TEST(ComparePoints, NearerPointsHideFurtherOnesInAnyOrder) {
    const ColorPoint near{0, 0, 1, 9, 0, 0, 0}, far{0, 0, 3, 7, 0, 0, 0};
    const Calibration camera = flat_camera();
    const auto view = render::view_of_camera(camera.depth, camera.room_from_camera, {9, 9});
    for (const PointCloud& cloud : {PointCloud{near, far}, PointCloud{far, near}}) {
        const auto picture = draw_points({{&cloud, camera.room_from_camera}}, view, {9, 9}, 0.5);
        EXPECT_EQ(picture.color.view().row(4)[4].r, 9);
        EXPECT_EQ(picture.depth_mm.view().row(4)[4], 1000);
        EXPECT_EQ(picture.depth_mm.view().row(0)[0], 0);
    }
}

TEST(ComparePoints, PointsBehindTheEyeAndBesideThePictureAreNotDrawn) {
    const PointCloud cloud = {
        {0, 0, -1, 9, 9, 9, 0}, {50, 0, 1, 9, 9, 9, 0}, {0, -50, 1, 9, 9, 9, 0}};
    const Calibration camera = flat_camera();
    const auto view = render::view_of_camera(camera.depth, camera.room_from_camera, {9, 9});
    EXPECT_EQ(draw_points({{&cloud, camera.room_from_camera}}, view, {9, 9}, 0.5).depth_mm,
              DepthImage({9, 9}));
}

TEST(PointFile, CloudsComeBackAndTruncatedFilesAreRefused) {
    const std::string file =
        (std::filesystem::path(::testing::TempDir()) / "compare_points_test.bin").string();
    const std::vector<PointCloud> clouds = {{{1, 2, 3, 4, 5, 6, 0}, {7, 8, 9, 1, 2, 3, 0}}, {}};
    ASSERT_TRUE(write_clouds(file, clouds));
    EXPECT_EQ(read_clouds(file), clouds);
    const auto whole = std::filesystem::file_size(file);
    for (std::uintmax_t size = 0; size < whole; ++size) {
        std::filesystem::resize_file(file, size);
        EXPECT_FALSE(read_clouds(file)) << size;
        ASSERT_TRUE(write_clouds(file, clouds));
    }
    std::filesystem::resize_file(file, whole + 1);
    EXPECT_FALSE(read_clouds(file));
    std::filesystem::remove(file);
    EXPECT_FALSE(read_clouds(file));
}

}  // namespace
}  // namespace theatron::bench
