// SPDX-License-Identifier: Apache-2.0
#include "room/moving.h"

#include <gtest/gtest.h>

#include "room/virtual_room.h"

namespace theatron::room {
namespace {

const RoomExtent extent{-3, 3, -4, 4, 2.8};
const FreeSpace space{extent, {}};

TEST(Moving, WallsAndFloorStopAnEye) {
    EXPECT_EQ(kept_inside(space, {1, 1.6, 2}), (Vec3{1, 1.6, 2}));
    const Vec3 corner = kept_inside(space, {9, -1, -9});
    EXPECT_LT(corner.x, 3);
    EXPECT_GT(corner.x, 2.7);
    EXPECT_GT(corner.y, 0);
    EXPECT_GT(corner.z, -4);
}

TEST(Moving, AnArcLandsOnTheFloorAhead) {
    const TeleportArc arc = teleport_arc(space, {0, 1.5, 3}, {0, -0.3, -1});
    ASSERT_TRUE(arc.landing);
    EXPECT_EQ(arc.landing->y, 0);
    EXPECT_NEAR(arc.landing->x, 0, 1e-9);
    EXPECT_LT(arc.landing->z, 2);
    EXPECT_EQ(arc.points.front(), (Vec3{0, 1.5, 3}));
    EXPECT_EQ(arc.points.back(), *arc.landing);
    for (const Vec3& point : arc.points)
        EXPECT_GE(point.y, 0);
    // Aiming higher lands farther away.
    EXPECT_LT(teleport_arc(space, {0, 1.5, 3}, {0, 0, -1}).landing->z, arc.landing->z);
}

TEST(Moving, AnArcThatMeetsAWallHasNoLanding) {
    const TeleportArc arc = teleport_arc(space, {2.5, 1.5, 0}, {1, 0.2, 0});
    EXPECT_FALSE(arc.landing);
    EXPECT_LE(arc.points.back().x, extent.right);
    EXPECT_FALSE(teleport_arc(space, {2.8, 1.5, 0}, {0, -1, 0}).landing) << "too near to a wall";
    EXPECT_FALSE(teleport_arc(space, {0, 1.5, 0}, {0, 0, 0}).landing);
    EXPECT_FALSE(teleport_arc(space, {0, -1, 50}, {0, 1, 0}).landing) << "outside";
}

TEST(Moving, FurnitureStopsAnEyeFromEachSide) {
    const FreeSpace with_table{extent, {{{-1, 0, -0.3}, {1, 0.9, 0.3}}}};
    for (const Vec3 free : {Vec3{0, 1.6, 0}, Vec3{0, 0.5, 1}, Vec3{-2, 0.5, 0}})
        EXPECT_EQ(kept_inside(with_table, free), free);
    EXPECT_GT(kept_inside(with_table, {0.2, 0.4, 0.25}).z, 0.3);
    EXPECT_LT(kept_inside(with_table, {0.2, 0.4, -0.25}).z, -0.3);
    EXPECT_GT(kept_inside(with_table, {0.9, 0.4, 0}).x, 1);
    EXPECT_GT(kept_inside(with_table, {0, 0.85, 0}).y, 0.9) << "from above";
}

TEST(Moving, AnArcLandsOnFreeFloorAlone) {
    const Vec3 from{0, 1.5, 3}, ahead{0, -0.3, -1};
    const Vec3 landing = teleport_arc(space, from, ahead).landing.value();
    FreeSpace with_table{extent, {{landing - Vec3{0.5, 0, 0.3}, landing + Vec3{0.5, 0.9, 0.3}}}};
    const TeleportArc arc = teleport_arc(with_table, from, ahead);
    EXPECT_FALSE(arc.landing);
    EXPECT_EQ(arc.points.back(), landing) << "it still shows where it leads";
    with_table.obstacles[0].low.x += 0.75;
    with_table.obstacles[0].high.x += 0.75;
    EXPECT_TRUE(teleport_arc(with_table, from, ahead).landing) << "beside it";
}

TEST(Moving, PeopleWhoMeetWithoutCamerasStandApartAndLookAtTheMiddle) {
    FreeSpace walls{extent_of({}).value(), {}};
    for (const furniture::Piece& piece : furniture::furnish(walls.extent, {}))
        if (piece.blocks)
            for (const furniture::Box& box : furniture::obstacles_of(piece))
                walls.obstacles.push_back(box);
    std::vector<Vec3> places;
    for (std::uint32_t person = 1; person <= 8; ++person) {
        const Pose eye = meeting_place(ParticipantId{person});
        EXPECT_EQ(kept_inside(walls, eye.translation), eye.translation);
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
