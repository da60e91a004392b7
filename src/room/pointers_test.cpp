// SPDX-License-Identifier: Apache-2.0
#include "room/pointers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/test_context.h"
#include "room/people.h"
#include "room/srgb.h"

namespace theatron::room {
namespace {

class PointersTest : public ::testing::Test {
protected:
    PointersTest() { render::test_context(); }
    render::SceneFrame seen(const Pointer& pointer) {
        render::SceneFrame frame;
        Pointers().add_to(frame, {pointer});
        return frame;
    }
    const Pointer pointer{ParticipantId{1}, "Anna", {0, 1.3, 0.5}, {0, 0, -1}, 0.5};
};

TEST_F(PointersTest, EndAtTheSurfaceWithADotAndTheName) {
    const render::SceneFrame frame = seen(pointer);
    ASSERT_EQ(frame.labels.size(), 1u);
    EXPECT_EQ(frame.labels[0].utf8, "Anna");
    ASSERT_EQ(frame.lines.size(), 1u);
    const Vec3 dot = frame.lines[0].room_from_line.translation;
    EXPECT_NEAR(length(dot - Vec3{0, 1.3, 0}), 0, 1e-9);
    EXPECT_EQ(frame.labels[0].place, dot);
    for (const render::SceneObject& object : frame.objects)
        EXPECT_GT(object.room_from_object.translation.z, 0);
}

TEST_F(PointersTest, OfTwoPeopleHaveEachADotOnTheOrganAndOnTheSliceInTheirColour) {
    Pointer anna = pointer, ben{ParticipantId{2}, "Ben", {0.2, 1.3, 0.5}, {0, 0, -1}, 0.5};
    anna.twin = Vec3{-0.5, 1.5, 0};
    ben.twin = Vec3{-0.5, 1.2, 0};
    render::SceneFrame frame;
    Pointers().add_to(frame, {anna, ben});
    for (const Pointer& one : {anna, ben})
        for (const Vec3 place : {one.from + one.direction * *one.reach_m, *one.twin}) {
            const auto dot = std::find_if(
                frame.lines.begin(), frame.lines.end(), [&](const render::SceneLine& line) {
                    return length(line.room_from_line.translation - place) < 1e-9;
                });
            ASSERT_NE(dot, frame.lines.end()) << one.name;
            EXPECT_EQ(dot->color, srgb_of(color_of(one.id))) << one.name;
        }
    ASSERT_EQ(frame.labels.size(), 2u);
    EXPECT_EQ(frame.labels[1].utf8, "Ben");
}

TEST_F(PointersTest, EndInTheAirWithoutDotAndName) {
    Pointer free = pointer;
    free.reach_m.reset();
    const render::SceneFrame frame = seen(free);
    EXPECT_TRUE(frame.labels.empty());
    EXPECT_TRUE(frame.lines.empty());
    const double reach = length(frame.objects.back().room_from_object.translation - free.from);
    EXPECT_NEAR(reach, Pointers::free_reach_m, 0.06);
}

TEST_F(PointersTest, AreNothingThatRaysMeet) {
    for (const render::SceneObject& object : seen(pointer).objects)
        EXPECT_EQ(object.id, render::PickId::none);
}

}  // namespace
}  // namespace theatron::room
