// SPDX-License-Identifier: Apache-2.0
// Changes from one picture to the next: cameras that come and go, objects that move, noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "geometry/camera_model.h"
#include "render/cloud_set.h"
#include "render/test_context.h"

namespace theatron::render {
namespace {

constexpr Size size{96, 72};
constexpr std::uint16_t wall_mm = 2000, board_mm = 1200;
constexpr Rgb red{200, 40, 40}, blue{40, 40, 200};

class OverTimeTest : public ::testing::TestWithParam<std::string> {
protected:
    OverTimeTest() {
        test_context();
        scene = std::make_unique<CloudSet>();
        calibration.depth = calibration.color = pinhole(size, 60);
        calibration.registered = true;
        // The colours tell the cameras apart, so no gains make them alike.
        calibration.color_gain = Vec3{1, 1, 1};
    }
    void TearDown() override {
        scene.reset();
        EXPECT_EQ(test_context().errors(), errors_before) << test_context().first_error();
    }

    void show(int camera, const DepthImage& depth, Rgb color) {
        ColorImage picture(size);
        std::fill(picture.pixels.begin(), picture.pixels.end(), color);
        scene->set_camera(CameraId(camera), calibration);
        ASSERT_EQ(scene->upload(CameraId(camera), depth.view(), picture.view()), Status::ok);
    }
    Picture render(const std::string& renderer) {
        return scene->render(view_of_camera(calibration.depth, calibration.room_from_camera, size),
                             size, renderer);
    }

    const int errors_before = test_context().errors();
    Calibration calibration;
    std::unique_ptr<CloudSet> scene;
};

INSTANTIATE_TEST_SUITE_P(EveryRenderer, OverTimeTest, ::testing::ValuesIn(renderer_names()),
                         [](const auto& test) { return test.param; });

// A board of 20 x 20 pixels; behind it a wall, or nothing that is measured.
DepthImage board_at(int left, std::uint16_t behind) {
    DepthImage depth(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            depth.view().row(y)[x] =
                x >= left && x < left + 20 && y >= 20 && y < 40 ? board_mm : behind;
    return depth;
}

DepthImage whole_wall() {
    return board_at(-100, wall_mm);
}

// The inside, where no border of the image disturbs.
template <class Work>
void for_inside(const Work& work) {
    for (int y = 4; y < size.height - 4; ++y)
        for (int x = 4; x < size.width - 4; ++x)
            work(x, y);
}

TEST_P(OverTimeTest, WhenACameraGoesTheOtherTakesOverStepByStep) {
    const DepthImage wall = whole_wall();
    show(0, wall, red);
    show(1, wall, blue);
    double before = 1, inside = 0;
    for_inside([&](int, int) { ++inside; });
    for (const double presence : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        scene->set_presence(CameraId{0}, presence);
        const Picture drawn = render(GetParam());
        double share = 0, missing = 0;
        for_inside([&](int x, int y) {
            missing += drawn.depth_mm.view().row(y)[x] == 0;
            share += (drawn.color.view().row(y)[x].r - blue.r) / double(red.r - blue.r) / inside;
        });
        EXPECT_EQ(missing, 0) << "presence " << presence;
        EXPECT_LE(share, before + 0.01) << "presence " << presence;
        EXPECT_GT(share, before - 0.6) << "presence " << presence;
        before = share;
    }
    EXPECT_NEAR(before, 0, 0.02) << "in the end only the other camera is seen";
}

TEST_P(OverTimeTest, WhatMovedLeavesNoTrace) {
    for (const std::uint16_t behind : {wall_mm, std::uint16_t(0)}) {
        for (int frame = 0; frame < 6; ++frame) {
            show(0, board_at(10, behind), red);
            (void)render(GetParam());
        }
        show(0, board_at(60, behind), red);
        const Picture moved = render(GetParam());
        scene = std::make_unique<CloudSet>();
        show(0, board_at(60, behind), red);
        const Picture fresh = render(GetParam());
        for_inside([&](int x, int y) {
            // An outline may be a pixel late, for two frames.
            const auto near = [](int a, int b) { return std::abs(a - b) <= 2; };
            if (!near(x, 60) && !near(x, 80) && !near(y, 20) && !near(y, 40)) {
                ASSERT_NEAR(moved.depth_mm.view().row(y)[x], fresh.depth_mm.view().row(y)[x], 1)
                    << "at " << x << ", " << y << " before " << behind << " mm";
            }
        });
    }
}

TEST_P(OverTimeTest, AColorThatChangesIsShownAtOnce) {
    const DepthImage wall = whole_wall();
    for (int frame = 0; frame < 3; ++frame) {
        show(0, wall, red);
        (void)render(GetParam());
    }
    show(0, wall, blue);
    EXPECT_EQ(render(GetParam()).color.view().row(50)[50], blue);
}

using SteadyTest = OverTimeTest;
INSTANTIATE_TEST_SUITE_P(Blend, SteadyTest, ::testing::Values("blend"));

TEST_P(SteadyTest, ColorNoiseIsHeldBack) {
    const DepthImage wall = whole_wall();
    for (int frame = 0; frame < 20; ++frame) {
        const std::uint8_t grey = frame % 2 == 0 ? 98 : 102;
        show(0, wall, {grey, grey, grey});
        const Rgb drawn = render("blend").color.view().row(50)[50];
        if (frame > 10) {
            EXPECT_NEAR(drawn.g, 100, 1);
        }
    }
}

TEST_P(SteadyTest, RimsThatComeAndGoStay) {
    // Every other pixel of the board's left column is missing in every other frame.
    DepthImage frayed = board_at(30, 0);
    for (int y = 20; y < 40; y += 2)
        frayed.view().row(y)[30] = 0;
    std::ptrdiff_t empty[2] = {};
    for (int frame = 0; frame < 8; ++frame) {
        show(0, frame % 2 == 0 ? board_at(30, 0) : frayed, red);
        const Picture picture = render("blend");
        empty[frame % 2] = std::count(picture.depth_mm.pixels.begin(),
                                      picture.depth_mm.pixels.end(), std::uint16_t(0));
    }
    EXPECT_EQ(empty[0], empty[1]);
}

TEST_P(SteadyTest, ALowStepKeepsItsEdge) {
    // 25 mm at 1.2 m: less than what tears a surface, more than noise.
    DepthImage step = whole_wall();
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            step.view().row(y)[x] = x < 48 ? board_mm : std::uint16_t(board_mm + 25);
    show(0, step, red);
    const Picture drawn = render("blend");
    EXPECT_NEAR(drawn.depth_mm.view().row(36)[46], board_mm, 2);
    EXPECT_NEAR(drawn.depth_mm.view().row(36)[49], board_mm + 25, 2);
}

}  // namespace
}  // namespace theatron::render
