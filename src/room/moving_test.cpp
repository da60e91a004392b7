// SPDX-License-Identifier: Apache-2.0
#include "room/moving.h"

#include <gtest/gtest.h>

namespace theatron::room {
namespace {

const RoomExtent extent{-3, 3, -4, 4, 2.8};

TEST(Moving, WallsAndFloorStopAnEye) {
    EXPECT_EQ(kept_inside(extent, {1, 1.6, 2}), (Vec3{1, 1.6, 2}));
    const Vec3 corner = kept_inside(extent, {9, -1, -9});
    EXPECT_LT(corner.x, 3);
    EXPECT_GT(corner.x, 2.7);
    EXPECT_GT(corner.y, 0);
    EXPECT_GT(corner.z, -4);
}

TEST(Moving, AnArcLandsOnTheFloorAhead) {
    const TeleportArc arc = teleport_arc(extent, {0, 1.5, 3}, {0, -0.3, -1});
    ASSERT_TRUE(arc.landing);
    EXPECT_EQ(arc.landing->y, 0);
    EXPECT_NEAR(arc.landing->x, 0, 1e-9);
    EXPECT_LT(arc.landing->z, 2);
    EXPECT_EQ(arc.points.front(), (Vec3{0, 1.5, 3}));
    EXPECT_EQ(arc.points.back(), *arc.landing);
    for (const Vec3& point : arc.points)
        EXPECT_GE(point.y, 0);
    // Aiming higher lands farther away.
    EXPECT_LT(teleport_arc(extent, {0, 1.5, 3}, {0, 0, -1}).landing->z, arc.landing->z);
}

TEST(Moving, AnArcThatMeetsAWallHasNoLanding) {
    const TeleportArc arc = teleport_arc(extent, {2.5, 1.5, 0}, {1, 0.2, 0});
    EXPECT_FALSE(arc.landing);
    EXPECT_LE(arc.points.back().x, extent.right);
    EXPECT_FALSE(teleport_arc(extent, {2.8, 1.5, 0}, {0, -1, 0}).landing) << "too near to a wall";
    EXPECT_FALSE(teleport_arc(extent, {0, 1.5, 0}, {0, 0, 0}).landing);
    EXPECT_FALSE(teleport_arc(extent, {0, -1, 50}, {0, 1, 0}).landing) << "outside";
}

TEST(Moving, PeopleWhoMeetWithoutCamerasStandApartAndLookAtTheMiddle) {
    const auto walls = extent_of({});
    ASSERT_TRUE(walls);
    std::vector<Vec3> places;
    for (std::uint32_t person = 1; person <= 8; ++person) {
        const Pose eye = meeting_place(ParticipantId{person});
        EXPECT_EQ(kept_inside(*walls, eye.translation), eye.translation);
        const Vec3 towards_middle = normalized(Vec3{0, 1.35, 0} - eye.translation);
        EXPECT_LT(length(rotate(eye.rotation, {0, 0, 1}) - towards_middle), 1e-9);
        for (const Vec3& other : places)
            EXPECT_GT(length(eye.translation - other), 0.6);
        places.push_back(eye.translation);
    }
}

TEST(Moving, StandsUprightAndLooksOn) {
    for (const Vec3 at : {Vec3{1, 0.4, 0}, Vec3{1, 1.6, 0}, Vec3{0.001, 0, 0}}) {
        const Pose eye = look_at({0, 1.6, 0}, at, {0, 1, 0});
        const Pose standing = standing_at({2, 0, 1}, eye, standing_eyes_m);
        EXPECT_LT(length(standing.translation - Vec3{2, standing_eyes_m, 1}), 1e-9);
        EXPECT_LT(length(rotate(standing.rotation, {0, 0, 1}) - Vec3{1, 0, 0}), 1e-2);
        EXPECT_LT(length(rotate(standing.rotation, {0, 1, 0}) - Vec3{0, -1, 0}), 1e-9);
    }
}

}  // namespace
}  // namespace theatron::room
