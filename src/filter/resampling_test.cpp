// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "filter/color_registration.h"
#include "filter/undistort.h"

namespace theatron::filter {
namespace {

CameraModel kinect_depth() {
    CameraModel camera = pinhole({160, 144}, 75);
    camera.k = {0.5479, -0.02097, -0.002652, 0.8897, 0.08613, -0.01391};
    camera.max_radius = 1.74;
    return camera;
}

TEST(Undistortion, OfALensWithoutDistortionChangesNothing) {
    const CameraModel camera = pinhole({30, 20}, 60);
    const Undistortion undistortion(camera, without_distortion(camera));
    DepthImage depth(camera.size), depth_out(camera.size);
    ColorImage color(camera.size), color_out(camera.size);
    for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
        depth.pixels[i] = std::uint16_t(i * 7);
        color.pixels[i] = {std::uint8_t(i), std::uint8_t(3 * i), std::uint8_t(5 * i)};
    }
    undistortion.apply(depth.view(), depth_out.view());
    undistortion.apply(color.view(), color_out.view());
    EXPECT_EQ(depth_out, depth);
    EXPECT_EQ(color_out, color);
}

TEST(Undistortion, PutsEachDirectionWhereAPinholeSeesIt) {
    // Depth that encodes the direction: each pixel's value is its x/z.
    const CameraModel lens = kinect_depth();
    const CameraModel plain = without_distortion(lens);
    DepthImage in(lens.size), out(lens.size);
    for (int y = 0; y < lens.size.height; ++y)
        for (int x = 0; x < lens.size.width; ++x)
            if (const auto ray = unproject(lens, {double(x), double(y)}))
                in.view().row(y)[x] = std::uint16_t(10000 + 5000 * ray->x);
    Undistortion(lens, plain).apply(in.view(), out.view());
    for (int y = 20; y < 124; y += 7)
        for (int x = 20; x < 140; x += 7) {
            const double direction = (x - plain.cx) / plain.fx;
            ASSERT_NEAR(out.view().row(y)[x], 10000 + 5000 * direction, 5000 / plain.fx) << x;
        }
}

// A red board in front of a green wall; the colour camera is to the right.
TEST(ColorRegistration, TheBoardsColourIsNotPaintedOnTheWall) {
    Calibration calibration;
    calibration.depth = pinhole({160, 120}, 70);
    calibration.color = pinhole({320, 240}, 80);
    calibration.color_from_depth.translation = {-0.06, 0, 0};
    const auto on_board = [](Vec3 point) {
        return std::abs(point.x) < 0.2 && std::abs(point.y) < 0.2;
    };
    const Vec3 eye{0.06, 0, 0};

    DepthImage depth(calibration.depth.size);
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x) {
            const Vec2 ray = unproject(calibration.depth, {double(x), double(y)}).value();
            depth.view().row(y)[x] = on_board({ray.x, ray.y, 1}) ? 1000 : 2500;
        }
    ColorImage color(calibration.color.size);
    for (int y = 0; y < color.size.height; ++y)
        for (int x = 0; x < color.size.width; ++x) {
            const Vec2 ray = unproject(calibration.color, {double(x), double(y)}).value();
            const bool red = on_board(eye + Vec3{ray.x, ray.y, 1});
            color.view().row(y)[x] = red ? Rgb{255, 0, 0} : Rgb{0, 255, 0};
        }

    ColorRegistration registration(calibration);
    ColorImage out(depth.size);
    Image<std::uint8_t> seen(depth.size);
    registration.apply(depth.view(), color.view(), out.view(), seen.view());
    int hidden = 0, colored = 0, wrong = 0;
    for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
        hidden += seen.pixels[i] == 0;
        colored += seen.pixels[i] != 0;
        if (seen.pixels[i] != 0)
            wrong += out.pixels[i] != (depth.pixels[i] == 1000 ? Rgb{255, 0, 0} : Rgb{0, 255, 0});
    }
    EXPECT_GT(hidden, 100) << "beside the board there is wall that the colour camera cannot see";
    EXPECT_GT(colored, 17000);
    EXPECT_LT(wrong, colored / 200) << "but for the board's own rim";
}

}  // namespace
}  // namespace theatron::filter
