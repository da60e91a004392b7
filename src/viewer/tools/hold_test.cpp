// SPDX-License-Identifier: Apache-2.0
// The mouse, hands and typed lines hold in the same way, with a few acts of one of them alone.
#include "viewer/tools/hold.h"

#include <gtest/gtest.h>

#include "room/bricks.h"
#include "session/shared_screen.h"

namespace theatron::viewer {
namespace {

namespace request = session::request;

// The room as the host has it after each request that it grants.
class HoldTest : public ::testing::Test {
protected:
    using ObjectId = session::ObjectId;
    static constexpr ParticipantId self{1}, ben{2};
    static constexpr ObjectId brick{5}, organ{6}, part{7}, screen{8};
    static constexpr std::uint32_t grip_number = 40;
    static constexpr double nearly = 1e-9;

    HoldTest() {
        add(brick, session::ObjectKind::brick, room::encode_brick({4, 2, 0}), {0, 1, -1});
        add(organ, session::ObjectKind::organ, session::encode_case_object(session::CaseOrgan{}),
            {1, 1, -1});
        objects_[organ].scale = 2;
        add(part, session::ObjectKind::organ, session::encode_case_object(session::CasePart{}),
            {0.25, 0, 0});
        add(screen, session::ObjectKind::screen,
            session::encode_shared_screen({CameraId{1}, false, {640, 480}, "Ben", "scope"}),
            {0, 2, -2});
        room::RoomPerson person;
        person.id = ben;
        person.name = "Ben";
        person.head = Pose{{}, {3, 1.6, 0}};
        people_.push_back(person);
    }
    void add(ObjectId id, session::ObjectKind kind, Bytes properties, Vec3 place) {
        session::RoomObject object;
        object.kind = kind;
        object.properties = std::move(properties);
        object.room_from_object.translation = place;
        objects_[id] = object;
    }
    HoldRoom room() {
        open_ = session::case_in_room(objects_);
        return {self, objects_, people_, open_};
    }
    // The host grants it.
    HoldStep take(ObjectId object, bool single = false, const std::optional<Grip>& grip = {},
                  Vec3 place = {}) {
        HoldStep step = hold_.take(room(), object, single, grip, place);
        for (const session::Request& asked : step.requests)
            objects_[std::get<request::Grab>(asked).object].grip = {self, grip_number};
        return step;
    }
    static Grip mouse(Vec3 direction) { return {{{0, 1, 0}, direction}}; }
    static Grip hand(double degrees) {
        return grip_of_hand({rotation_about({0, 1, 0}, radians_of(degrees)), {0, 1, 0}});
    }
    static void expect_near(Vec3 a, Vec3 b) {
        EXPECT_NEAR(length(a - b), 0, nearly) << a.x << " " << a.y << " " << a.z;
    }

    session::RoomObjects objects_;
    std::vector<room::RoomPerson> people_;
    std::optional<session::CaseInRoom> open_;
    Hold hold_;
};

TEST_F(HoldTest, TheMouseMovesAnObjectAndDoesNotTurnIt) {
    ASSERT_EQ(take(brick, false, mouse({0, 0, -1}), {0, 1, -1}).requests.size(), 1u);
    hold_.grasp()->point(mouse({-1, 0, 0}));
    const HoldMove move = *hold_.move(room());
    EXPECT_EQ(move.object, brick);
    expect_near(move.room_from_object.translation, {-1, 1, 0});
    EXPECT_EQ(move.room_from_object.rotation, Quat{});
}

TEST_F(HoldTest, AHandTurnsWhatItHoldsAndPushesItAway) {
    (void)take(brick, false, hand(0), {0, 1, -1});
    hold_.grasp()->point(hand(90));
    HoldMove move = *hold_.move(room());
    expect_near(move.room_from_object.translation, {-1, 1, 0});
    expect_near(rotate(move.room_from_object.rotation, {0, 0, -1}), {-1, 0, 0});
    hold_.grasp()->push(0.5);
    expect_near(hold_.move(room())->room_from_object.translation, {-1.5, 1, 0});
    hold_.grasp()->push(-5);
    expect_near(hold_.move(room())->room_from_object.translation, {-0.05, 1, 0});
}

TEST_F(HoldTest, ATypedLinePutsAnObjectAtAPlace) {
    (void)take(brick);
    EXPECT_EQ(hold_.grasp(), nullptr);
    hold_.put({{}, {2, 1, 0}});
    expect_near(hold_.move(room())->room_from_object.translation, {2, 1, 0});
    const HoldStep step = hold_.let_go(room());
    const auto& release = std::get<request::Release>(step.requests.at(0));
    EXPECT_EQ(release.grip, grip_number);
    expect_near(release.room_from_object.translation, {2, 1, 0});
    EXPECT_FALSE(hold_.holds());
}

TEST_F(HoldTest, APinnedScreenIsNotTakenAndTheReasonIsSaid) {
    objects_[screen].properties =
        session::encode_shared_screen({CameraId{1}, true, {640, 480}, "Ben", "scope"});
    for (const std::optional<Grip>& grip :
         {std::optional<Grip>(), std::optional(mouse({0, 0, -1})), std::optional(hand(0))}) {
        const HoldStep step = take(screen, false, grip);
        EXPECT_TRUE(step.requests.empty());
        EXPECT_NE(step.note.find("pinned"), std::string::npos) << step.note;
        EXPECT_FALSE(hold_.holds());
    }
}

TEST_F(HoldTest, WhatAnotherPersonHoldsStaysThere) {
    objects_[brick].grip = {ben, 3};
    const HoldStep step = take(brick);
    EXPECT_TRUE(step.requests.empty());
    EXPECT_EQ(step.note, "Ben holds this");
}

TEST_F(HoldTest, APartIsTakenOutOfItsOrganWhereThatIsMeant) {
    (void)take(part);
    EXPECT_EQ(hold_.object(), organ);
    objects_[organ].grip = {};
    (void)take(part, true, mouse({1.5, 0, -1}), {1.5, 1, -1});
    EXPECT_EQ(hold_.object(), part);
    // Its pose in the room's state is relative to the organ, which has twice its size.
    expect_near(hold_.move(room())->room_from_object.translation, {0.25, 0, 0});
    hold_.put({{}, {1, 2, -1}});
    expect_near(hold_.move(room())->room_from_object.translation, {0, 0.5, 0});
}

TEST_F(HoldTest, AnObjectThatIsGoneOrRefusedIsNotHeld) {
    (void)take(brick);
    EXPECT_TRUE(hold_.follow(room()));
    objects_[brick].grip = {};
    EXPECT_FALSE(hold_.follow(room()));
    (void)take(brick);
    objects_.erase(brick);
    EXPECT_FALSE(hold_.follow(room()));
    EXPECT_FALSE(hold_.holds());
}

TEST_F(HoldTest, AGivenObjectIsHeldWithoutATake) {
    EXPECT_FALSE(hold_.adopt(room()));
    objects_[brick].grip = {self, grip_number};
    EXPECT_TRUE(hold_.adopt(room()));
    EXPECT_EQ(hold_.object(), brick);
    expect_near(hold_.move(room())->room_from_object.translation, {0, 1, -1});
}

TEST_F(HoldTest, AnObjectIsGivenToTheNearestPersonOrByAHandThatIsNear) {
    (void)take(brick);
    HoldStep step = hold_.give_to_nearest(room());
    EXPECT_EQ(std::get<request::HandOver>(step.requests.at(0)).to, ben);
    EXPECT_EQ(step.note, "Given to Ben");
    EXPECT_FALSE(hold_.holds());

    (void)take(brick);
    hold_.put({{}, {3, 1.4, 0}});
    EXPECT_TRUE(
        std::holds_alternative<request::HandOver>(hold_.let_go_by_hand(room()).requests.at(0)));
    (void)take(brick);
    hold_.put({{}, {3, 1.2, 0}});
    EXPECT_TRUE(
        std::holds_alternative<request::Release>(hold_.let_go_by_hand(room()).requests.at(0)));

    people_.clear();
    (void)take(brick);
    step = hold_.give_to_nearest(room());
    EXPECT_TRUE(step.requests.empty());
    EXPECT_NE(step.note, "");
    EXPECT_TRUE(hold_.holds());
}

TEST_F(HoldTest, BricksSnapTogetherWhenTheyAreLetGo) {
    const ObjectId other{9};
    add(other, session::ObjectKind::brick, room::encode_brick({4, 2, 0}), {0, 1, -2});
    (void)take(brick);
    Pose above = room::snapped({4, 2, 0}, {{}, {0, 1.03, -2}}, {{{4, 2, 0}, {{}, {0, 1, -2}}}});
    hold_.put({{}, above.translation + Vec3{0.004, 0.003, 0}});
    const HoldStep step = hold_.let_go(room());
    expect_near(std::get<request::Release>(step.requests.at(0)).room_from_object.translation,
                above.translation);
}

TEST_F(HoldTest, RemovingHidesAPartAndLeavesScreensAndOrgansToTheirPanels) {
    (void)take(brick);
    EXPECT_TRUE(std::holds_alternative<request::Remove>(hold_.remove(room()).requests.at(0)));
    (void)take(part, true);
    const HoldStep step = hold_.remove(room());
    ASSERT_EQ(step.requests.size(), 2u);
    EXPECT_TRUE(std::holds_alternative<request::Release>(step.requests[0]));
    const auto& hidden = std::get<request::SetProperties>(step.requests[1]);
    EXPECT_FALSE(
        session::decode_as<session::CasePart>(session::ObjectKind::organ, hidden.properties)
            ->shown);
    for (const ObjectId object : {organ, screen}) {
        (void)take(object);
        EXPECT_TRUE(hold_.remove(room()).requests.empty());
        EXPECT_TRUE(hold_.holds());
    }
}

TEST_F(HoldTest, TwoHandsScaleScreensAndOrgansWithinLimits) {
    (void)take(brick);
    EXPECT_FALSE(hold_.begin_stretch(room(), 0.4)) << "a brick keeps its size";
    (void)take(organ);
    ASSERT_TRUE(hold_.begin_stretch(room(), 0.4));
    hold_.stretch(room(), 0.8);
    EXPECT_NEAR(hold_.move(room())->scale, 4, nearly);
    hold_.stretch(room(), 40);
    EXPECT_NEAR(hold_.scale(), 4, nearly) << "beyond the limit it stays";
    hold_.end_stretch();
    hold_.stretch(room(), 0.4);
    EXPECT_NEAR(hold_.scale(), 4, nearly);
    (void)take(screen);
    ASSERT_TRUE(hold_.begin_stretch(room(), 0.4));
    hold_.stretch(room(), 0.2);
    EXPECT_NEAR(hold_.scale(), 0.5, nearly);
}

}  // namespace
}  // namespace theatron::viewer
