// SPDX-License-Identifier: Apache-2.0
#include "geometry/ply.h"

#include <gtest/gtest.h>

namespace theatron {
namespace {

TEST(Ply, BytesAreAsTheFormatSays) {
    const ColoredPoint points[] = {{1.0f, -2.0f, 0.5f, {1, 2, 255}}};
    const std::string expected =
        std::string(
            "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
            "property float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n") +
        std::string("\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x00\x00\x3f\x01\x02\xff", 15);
    const Bytes bytes = encode_ply(points);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), expected);
}

TEST(Ply, CommentsStandInTheHeader) {
    const std::string comments[] = {points_in_room, "", "not live"};
    const Bytes bytes = encode_ply({}, comments);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())
                  .rfind("ply\nformat binary_little_endian 1.0\n"
                         "comment x, y, z in metres in the room: y up, 0 on the floor, "
                         "right-handed\n"
                         "comment not live\nelement vertex 0\n",
                         0),
              0u);
}

TEST(Ply, PointsLieOnTheirRaysAndHaveTheColourThatSeesThem) {
    Calibration calibration;
    calibration.depth = pinhole({4, 2}, 90);
    calibration.color = pinhole({8, 4}, 90);
    calibration.depth_unit_mm = 2;
    DepthImage depth({4, 2});
    depth.pixels[5] = 1000;  // column 1, row 1
    ColorImage color({8, 4});
    for (int i = 0; i < 32; ++i)
        color.pixels[std::size_t(i)] = {std::uint8_t(i % 8), std::uint8_t(i / 8), 7};

    std::vector<ColoredPoint> points;
    append_points(depth.view(), make_ray_table(calibration.depth), color.view(), calibration,
                  points);
    ASSERT_EQ(points.size(), 1u);
    // 2 m away, half a pixel left of and below the centre; a pixel subtends half its distance.
    EXPECT_NEAR(points[0].x, -0.5, 1e-5);
    EXPECT_NEAR(points[0].y, 0.5, 1e-5);
    EXPECT_NEAR(points[0].z, 2, 1e-5);
    EXPECT_TRUE(points[0].color.b == 7 && points[0].color.r >= 2 && points[0].color.r <= 3);

    transform_points({{}, {1, 0, -2}}, points);
    EXPECT_NEAR(points[0].x, 0.5, 1e-5);
    EXPECT_NEAR(points[0].z, 0, 1e-5);
}

TEST(Ply, PointsThatNoColourCameraSeesAreGrey) {
    Calibration calibration;
    calibration.depth = pinhole({2, 2}, 90);
    calibration.color = pinhole({2, 2}, 90);
    calibration.color_from_depth.translation = {100, 0, 0};
    DepthImage depth({2, 2});
    depth.pixels = {1000, 0, 0, 0};
    std::vector<ColoredPoint> points;
    append_points(depth.view(), make_ray_table(calibration.depth), ColorImage({2, 2}).view(),
                  calibration, points);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].color, unseen_color);
}

}  // namespace
}  // namespace theatron
