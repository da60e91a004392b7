// SPDX-License-Identifier: Apache-2.0
#include "geometry/color_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace theatron {
namespace {

constexpr Size depth_size{320, 240}, color_size{320, 240};
constexpr std::uint16_t wall_mm = 2000;

// Cameras side by side in front of a wall, in pictures of one colour.
class ColorBalanceTest : public ::testing::Test {
protected:
    static Calibration calibration(int camera) {
        Calibration c;
        c.depth = c.color = pinhole(depth_size, 75);
        c.registered = true;
        c.room_from_camera.translation = {0.3 * camera, 1.5, 0};
        return c;
    }
    void show(int camera, Rgb color, const Calibration& calibration) {
        DepthImage depth(depth_size);
        std::fill(depth.pixels.begin(), depth.pixels.end(), wall_mm);
        ColorImage picture(color_size);
        std::fill(picture.pixels.begin(), picture.pixels.end(), color);
        balance_.add(CameraId(camera), calibration, std::as_const(depth).view(),
                     std::as_const(picture).view());
    }
    void show(int camera, Rgb color) { show(camera, color, calibration(camera)); }

    ColorBalance balance_{1};
};

// The sRGB curve is only about a power.
constexpr double curve = 0.02;

void expect_near(std::optional<Vec3> gain, Vec3 expected) {
    ASSERT_TRUE(gain);
    EXPECT_NEAR(gain->x, expected.x, curve * expected.x);
    EXPECT_NEAR(gain->y, expected.y, curve * expected.y);
    EXPECT_NEAR(gain->z, expected.z, curve * expected.z);
}

TEST_F(ColorBalanceTest, MakesTheColoursOfTwoExposuresAlikeHalfwayBetweenThem) {
    show(0, {100, 120, 140});
    EXPECT_FALSE(balance_.update()) << "one alone";
    show(1, {144, 120, 100});
    ASSERT_TRUE(balance_.update());
    const double red = std::sqrt(1.44), blue = std::sqrt(1.4);
    expect_near(balance_.newest_gain(CameraId{0}), {red, 1, 1 / blue});
    expect_near(balance_.newest_gain(CameraId{1}), {1 / red, 1, blue});
    EXPECT_EQ(balance_.gain(CameraId{0}), balance_.newest_gain(CameraId{0})) << "the first one";
}

TEST_F(ColorBalanceTest, ComparesASlantedWallInSmallImages) {
    constexpr Size small{320, 240};
    for (const auto& [camera, color] : {std::pair{0, Rgb{100, 120, 140}}, {1, {144, 120, 100}}}) {
        Calibration c = calibration(camera);
        c.depth = c.color = pinhole(small, 75);
        DepthImage depth(small);
        // z = 2.5 m + x in the room.
        for (int y = 0; y < small.height; ++y)
            for (int x = 0; x < small.width; ++x) {
                const auto ray = unproject(c.depth, {double(x), double(y)});
                const double z_m = (2.5 + c.room_from_camera.translation.x) / (1 - ray->x);
                depth.view().row(y)[x] = z_m < 6 ? std::uint16_t(std::lround(1000 * z_m)) : 0;
            }
        ColorImage picture(small);
        std::fill(picture.pixels.begin(), picture.pixels.end(), color);
        balance_.add(CameraId(camera), c, std::as_const(depth).view(),
                     std::as_const(picture).view());
    }
    ASSERT_TRUE(balance_.update());
    expect_near(balance_.newest_gain(CameraId{0}), {1.2, 1, 1 / std::sqrt(1.4)});
}

TEST_F(ColorBalanceTest, FollowsACameraWhoseCalibrationHasGains) {
    Calibration known = calibration(0);
    known.color_gain = {1.2, 1, 1};
    show(1, {120, 120, 100});
    show(0, {100, 120, 140}, known);
    ASSERT_TRUE(balance_.update());
    EXPECT_FALSE(balance_.newest_gain(CameraId{0}));
    expect_near(balance_.newest_gain(CameraId{1}), {1, 1, 1.4});
}

TEST_F(ColorBalanceTest, HasNothingToDoWhereAllHaveGains) {
    for (int camera : {0, 1}) {
        Calibration known = calibration(camera);
        known.color_gain = {1, 1, 1};
        show(camera, {100, 120, 140}, known);
    }
    EXPECT_FALSE(balance_.update());
}

TEST_F(ColorBalanceTest, ComparesOnlyCamerasThatSeeTheSameSurface) {
    Calibration apart = calibration(2);
    apart.room_from_camera.translation.x += 50;
    show(0, {100, 120, 140});
    show(1, {120, 120, 140});
    show(2, {200, 120, 140}, apart);
    ASSERT_TRUE(balance_.update());
    EXPECT_TRUE(balance_.newest_gain(CameraId{0}));
    EXPECT_FALSE(balance_.newest_gain(CameraId{2}));
    EXPECT_EQ(balance_.gain(CameraId{2}), (Vec3{1, 1, 1}));
}

// Otherwise all others would change when one is covered.
TEST_F(ColorBalanceTest, KeepsTheLevelOfTheUsualGains) {
    show(0, {100, 100, 100});
    show(1, {100, 100, 100});
    for (const int camera : {0, 1})
        balance_.set_usual_gain(CameraId(camera), {1.3, 1.3, 0.8});
    ASSERT_TRUE(balance_.update());
    for (const int camera : {0, 1})
        expect_near(balance_.newest_gain(CameraId(camera)), {1.3, 1.3, 0.8});

    show(0, {100, 100, 100});
    show(1, {121, 100, 100});
    ASSERT_TRUE(balance_.update());
    expect_near(balance_.newest_gain(CameraId{0}), {1.3 * 1.1, 1.3, 0.8});
    expect_near(balance_.newest_gain(CameraId{1}), {1.3 / 1.1, 1.3, 0.8});
}

TEST_F(ColorBalanceTest, ChangesSlowlyExceptForTheNewestEstimate) {
    show(0, {100, 100, 100});
    show(1, {100, 100, 100});
    ASSERT_TRUE(balance_.update());
    show(0, {100, 100, 100});
    show(1, {144, 100, 100});
    ASSERT_TRUE(balance_.update());
    EXPECT_NEAR(balance_.newest_gain(CameraId{0})->x, 1.2, 0.03);
    EXPECT_NEAR(balance_.gain(CameraId{0}).x, 1.04, 0.01);
}

}  // namespace
}  // namespace theatron
