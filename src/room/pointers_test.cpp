// SPDX-License-Identifier: Apache-2.0
#include "room/pointers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/room_picture.h"
#include "render/test_context.h"
#include "room/people.h"

namespace theatron::room {
namespace {

class PointersTest : public ::testing::Test {
protected:
    PointersTest() { render::test_context(); }
    render::SceneFrame seen(const Pointer& pointer) {
        render::SceneFrame frame;
        Pointers().add_to(frame, {pointer}, view);
        return frame;
    }
    const render::CameraView view = render::view_towards({0, 1.6, 1}, {0, 1.6, 0}, 60, {160, 120});
    const Pointer pointer{ParticipantId{1}, "Anna", {0, 1.3, 0.5}, {0, 0, -1}, 0.5};
};

TEST_F(PointersTest, EndAtTheSurfaceWithADotAndTheName) {
    const render::SceneFrame frame = seen(pointer);
    ASSERT_EQ(frame.texts.size(), 1u);
    EXPECT_EQ(frame.texts[0].utf8, "Anna");
    const Vec3 dot = frame.objects.back().room_from_object.translation;
    EXPECT_NEAR(length(dot - Vec3{0, 1.3, 0}), 0, 1e-9);
    EXPECT_LT(length(frame.texts[0].room_from_text.translation - dot), 0.05);
    for (std::size_t i = 0; i + 1 < frame.objects.size(); ++i)
        EXPECT_GT(frame.objects[i].room_from_object.translation.z, 0);
}

TEST_F(PointersTest, OfTwoPeopleHaveEachADotOnTheOrganAndOnTheSliceInTheirColour) {
    Pointer anna = pointer, ben{ParticipantId{2}, "Ben", {0.2, 1.3, 0.5}, {0, 0, -1}, 0.5};
    anna.twin = Vec3{-0.5, 1.5, 0};
    ben.twin = Vec3{-0.5, 1.2, 0};
    render::SceneFrame frame;
    Pointers().add_to(frame, {anna, ben}, view);
    for (const Pointer& one : {anna, ben})
        for (const Vec3 place : {one.from + one.direction * *one.reach_m, *one.twin}) {
            const auto dot = std::find_if(
                frame.objects.begin(), frame.objects.end(), [&](const render::SceneObject& object) {
                    return length(object.room_from_object.translation - place) < 1e-9;
                });
            ASSERT_NE(dot, frame.objects.end()) << one.name;
            EXPECT_EQ(dot->look.base_color, color_of(one.id)) << one.name;
        }
    ASSERT_EQ(frame.texts.size(), 2u);
    EXPECT_EQ(frame.texts[1].utf8, "Ben");
}

TEST_F(PointersTest, EndInTheAirWithoutDotAndName) {
    Pointer free = pointer;
    free.reach_m.reset();
    const render::SceneFrame frame = seen(free);
    EXPECT_TRUE(frame.texts.empty());
    const double reach = length(frame.objects.back().room_from_object.translation - free.from);
    EXPECT_NEAR(reach, Pointers::free_reach_m, 0.06);
}

TEST_F(PointersTest, AreNothingThatRaysMeet) {
    for (const render::SceneObject& object : seen(pointer).objects)
        EXPECT_EQ(object.id, render::ObjectId::none);
}

}  // namespace
}  // namespace theatron::room
