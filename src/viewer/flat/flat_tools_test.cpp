// SPDX-License-Identifier: Apache-2.0
#include "viewer/flat/flat_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/image.h"

namespace theatron::viewer {
namespace {

// A wall at z 0, seen from z 2 along -z.
class FlatToolsTest : public ::testing::Test {
protected:
    FlatToolsTest() : depth(Size{160, 120}) {
        std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(2000));
        calibration.depth = pinhole(depth.size, 70);
        calibration.color = pinhole({320, 240}, 60);
        calibration.room_from_camera = look_at({0, 1.5, 2}, {0, 1.5, 0}, {0, 1, 0});
    }
    FlatPicture picture() const { return {CameraId{3}, calibration, depth.view()}; }
    void hover(Vec2 at) {
        window::WindowInput input;
        input.pointer = at;
        give(input);
    }
    void press(Vec2 at) {
        window::WindowInput input;
        input.grabbed = input.pointer = at;
        input.grabbed_left = true;
        give(input);
    }
    void release(Vec2 at) {
        window::WindowInput input;
        input.pointer = at;
        input.released = true;
        give(input);
    }
    void point(Vec2 at) {
        window::WindowInput input;
        input.pointer = at;
        input.points = true;
        give(input);
    }
    void give(const window::WindowInput& input) {
        const FlatPicture seen = picture();
        tools.on_input(input, &seen, true);
    }

    DepthImage depth;
    Calibration calibration;
    FlatTools tools;
};

TEST_F(FlatToolsTest, PointingFindsThePlaceBelowThePointerAndEndsWithIt) {
    EXPECT_FALSE(tools.are_used());
    point({0.5, 0.5});
    EXPECT_TRUE(tools.are_used());
    ASSERT_TRUE(tools.pointed());
    EXPECT_NEAR(length(*tools.pointed() - Vec3{0, 1.5, 0}), 0, 0.01);
    // The ray meets the same place, from the camera's side.
    const render::PickRay ray = *tools.pointing();
    EXPECT_NEAR(ray.from.z, 0.6, 0.01);
    EXPECT_NEAR(ray.direction.z, -1, 0.01);
    EXPECT_FALSE(tools.take_advice());
    hover({0.5, 0.5});
    EXPECT_FALSE(tools.pointing());
    EXPECT_FALSE(tools.are_used());
}

TEST_F(FlatToolsTest, AStrokeIsDrawnOnTheWall) {
    tools.choose(ToolKind::stroke);
    EXPECT_TRUE(tools.are_used());
    press({0.4, 0.5});
    for (int i = 1; i <= 10; ++i)
        hover({0.4 + 0.02 * i, 0.5});
    ASSERT_TRUE(tools.drawn());
    release({0.6, 0.5});
    EXPECT_FALSE(tools.drawn());
    const auto marks = tools.take_marks();
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_EQ(marks[0].surface, session::MarkedSurface::cloud);
    EXPECT_GE(marks[0].points.size(), 10u);
    for (const auto& at : marks[0].points)
        EXPECT_NEAR(at.position.z, 0, 0.002);
    EXPECT_NEAR(length(marks[0].points.back().position - marks[0].points.front().position),
                0.2 * 2 * 2 * std::tan(radians_of(30)), 0.02);
    EXPECT_TRUE(tools.take_marks().empty());
}

TEST_F(FlatToolsTest, ARestingPointerDrawsNothingWhereTheSurfaceMoves) {
    tools.choose(ToolKind::stroke);
    press({0.5, 0.5});
    for (int i = 0; i < 20; ++i) {
        std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(2000 + 5 * (i % 2)));
        hover({0.5, 0.5});
    }
    EXPECT_EQ(tools.drawn()->points.size(), 2u);
    release({0.5, 0.5});
    EXPECT_TRUE(tools.take_marks().empty());
    EXPECT_EQ(tools.take_advice(), Phrase::draw_by_dragging);
}

TEST_F(FlatToolsTest, WhatIsBeingDrawnCanBeGivenUp) {
    EXPECT_FALSE(tools.give_up()) << "there is no tool";
    tools.choose(ToolKind::distance);
    EXPECT_FALSE(tools.give_up()) << "nothing is drawn";
    press({0.4, 0.5});
    release({0.4, 0.5});
    ASSERT_TRUE(tools.drawn());
    EXPECT_TRUE(tools.give_up());
    EXPECT_FALSE(tools.drawn());
    // The next press begins another one.
    press({0.6, 0.5});
    release({0.6, 0.5});
    EXPECT_TRUE(tools.take_marks().empty());
    EXPECT_TRUE(tools.drawn());
}

TEST_F(FlatToolsTest, ADistanceByTwoClicksHasItsUncertainty) {
    tools.choose(ToolKind::distance);
    press({0.4, 0.5});
    release({0.4, 0.5});
    EXPECT_EQ(tools.take_advice(), Phrase::press_at_other_end);
    hover({0.6, 0.5});
    press({0.6, 0.5});
    release({0.6, 0.5});
    const auto marks = tools.take_marks();
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_GT(marks[0].deviation_m, 0);
}

TEST_F(FlatToolsTest, APressThatCannotDrawSaysWhy) {
    tools.choose(ToolKind::pin);
    std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(0));
    press({0.5, 0.5});
    EXPECT_EQ(tools.take_advice(), Phrase::begin_on_surface);
    window::WindowInput input;
    input.grabbed = Vec2{0.5, 0.5};
    input.grabbed_left = true;
    const FlatPicture not_yet{CameraId{3}, calibration, {}};
    tools.on_input(input, &not_yet, true);
    EXPECT_EQ(tools.take_advice(), Phrase::depth_is_awaited);
    tools.on_input(input, &not_yet, false);
    EXPECT_EQ(tools.take_advice(), Phrase::camera_without_depth);
    tools.on_input(input, nullptr, true);
    EXPECT_EQ(tools.take_advice(), Phrase::depth_is_awaited);
    EXPECT_TRUE(tools.take_marks().empty());
}

TEST_F(FlatToolsTest, PointingWithoutASurfaceIsToldOnce) {
    window::WindowInput input;
    input.points = true;
    input.pointer = Vec2{0.5, 0.5};
    tools.on_input(input, nullptr, true);
    EXPECT_EQ(tools.take_advice(), Phrase::depth_is_awaited);
    tools.on_input(input, nullptr, true);
    EXPECT_FALSE(tools.take_advice());
    EXPECT_TRUE(tools.are_used());
}

TEST_F(FlatToolsTest, WhereNothingWasMeasuredPointingSaysSoOnceUntilItMeetsASurface) {
    point({0.5, 0.5});
    EXPECT_FALSE(tools.take_advice());
    std::fill(depth.pixels.begin(), depth.pixels.end(), std::uint16_t(0));
    point({0.6, 0.5});
    EXPECT_FALSE(tools.pointing());
    EXPECT_EQ(tools.take_advice(), Phrase::points_at_nothing);
    point({0.7, 0.5});
    EXPECT_FALSE(tools.take_advice());
}

TEST_F(FlatToolsTest, AStrokeEndsWithItsPictureAndADistanceWaitsForItsOtherEnd) {
    tools.choose(ToolKind::stroke);
    press({0.4, 0.5});
    for (int i = 1; i <= 5; ++i)
        hover({0.4 + 0.02 * i, 0.5});
    tools.lift();
    EXPECT_FALSE(tools.drawn());
    EXPECT_EQ(tools.take_marks().size(), 1u);
    hover({0.8, 0.5});
    release({0.8, 0.5});
    EXPECT_TRUE(tools.take_marks().empty());
    tools.choose(ToolKind::distance);
    press({0.4, 0.5});
    release({0.4, 0.5});
    tools.lift();
    press({0.6, 0.5});
    release({0.6, 0.5});
    EXPECT_EQ(tools.take_marks().size(), 1u);
}

TEST_F(FlatToolsTest, ToolsOfACaseAreNone) {
    tools.choose(ToolKind::slice);
    EXPECT_EQ(tools.chosen(), ToolKind::none);
    EXPECT_FALSE(tools.are_used());
}

}  // namespace
}  // namespace theatron::viewer
