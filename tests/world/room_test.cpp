// SPDX-License-Identifier: Apache-2.0
// People in one room: they see each other and the same objects, whatever their links do.
#include <gmock/gmock.h>

#include "wire/person_pose.h"
#include "world/acts.h"

namespace theatron::world {
namespace {

using session::ObjectId;
using session::ObjectKind;
using session::Refusal;
using ::testing::ElementsAre;

TEST(WorldRoom, PeopleMeetWithoutACamera) {
    World world;
    Person& anna = world.joined("Anna");
    EXPECT_THAT(anna.sees(), ElementsAre("Anna"));
    Person& ben = world.joined("Ben");
    EXPECT_TRUE(world.until([&] { return anna.sees().size() == 2; }));
    EXPECT_THAT(anna.sees(), ElementsAre("Anna", "Ben"));
    EXPECT_EQ(anna.sees(), ben.sees());
    EXPECT_TRUE(world.until([&] { return world.host().participants() == 2; }));
    ben.leave();
    EXPECT_TRUE(world.until([&] { return anna.sees().size() == 1; }));
    EXPECT_TRUE(world.until([&] { return world.host().participants() == 1; }));
    EXPECT_EQ(world.host().figures().faults, 0u);
}

TEST(WorldRoom, PosesAreSeenByTheOthersAndEndWithTheirPerson) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    wire::PersonPose pose;
    pose.time = ben->now();
    pose.head = wire::PartPose{{0.5f, 1.6f, -1}};
    ben->send_pose(pose);
    EXPECT_TRUE(world.until([&] { return anna->poses().contains(ben.number()); }));
    const auto seen = anna->poses().at(ben.number());
    ASSERT_TRUE(seen.head);
    EXPECT_EQ(seen.head->position[0], 0.5f);
    world.advance(1s);
    EXPECT_TRUE(ben->poses().empty());  // not one's own
    Person& carl = world.joined("Carl");
    EXPECT_TRUE(world.until([&] { return carl->poses().contains(ben.number()); }));
    const ParticipantId left = ben.number();
    ben.leave();
    EXPECT_TRUE(world.until([&] { return !anna->poses().contains(left); }));
    EXPECT_TRUE(world.until([&] { return !carl->poses().contains(left); }));
}

TEST(WorldRoom, FacesAreSeenByTheOthersAndEndWithTheirPerson) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    wire::FaceExpression smile;
    smile.time = ben->now();
    smile.state = wire::FaceExpression::State::tracked;
    smile.emotions[2] = 1;
    ben->send_expression(smile);
    EXPECT_TRUE(world.until([&] { return anna->expressions().contains(ben.number()); }));
    EXPECT_EQ(anna->expressions().at(ben.number()), smile);
    EXPECT_TRUE(anna->poses().empty());
    Person& carl = world.joined("Carl");
    EXPECT_TRUE(world.until([&] { return carl->expressions().contains(ben.number()); }));
    const ParticipantId left = ben.number();
    ben.leave();
    EXPECT_TRUE(world.until([&] { return !anna->expressions().contains(left); }));
    EXPECT_TRUE(world.until([&] { return !carl->expressions().contains(left); }));
}

TEST(WorldRoom, ABrickIsHeldMovedGivenAndReleased) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, anna, {0.2, 1.25, 0.3});
    ASSERT_NE(brick, ObjectId{});
    EXPECT_TRUE(world.until([&] { return ben.room().objects.contains(brick); }));

    EXPECT_EQ(grab(world, anna, brick), Refusal::none);
    EXPECT_EQ(holder(ben, brick), anna.number());
    EXPECT_EQ(grab(world, ben, brick), Refusal::held_by_another);
    EXPECT_FALSE(ben->move_object(brick, {{}, {1, 1, 1}}, 1));
    EXPECT_TRUE(anna->move_object(brick, {{}, {0.5, 1, 0}}, 2));
    const auto place = [&](Person& person) {
        return person.room().objects.at(brick).room_from_object.translation;
    };
    EXPECT_TRUE(world.until([&] { return place(ben).x == 0.5; }));
    EXPECT_EQ(ben.room().objects.at(brick).scale, 2);

    EXPECT_EQ(give(world, anna, brick, ben), Refusal::none);
    EXPECT_EQ(holder(anna, brick), ben.number());
    EXPECT_EQ(release(world, anna, brick), Refusal::not_held_by_you);
    EXPECT_TRUE(ben->move_object(brick, {{}, {0, 1.5, 0}}, 2));
    EXPECT_EQ(release(world, ben, brick), Refusal::none);
    EXPECT_TRUE(world.until([&] { return holder(anna, brick) == ParticipantId{}; }));
    EXPECT_EQ(place(anna).y, 1.5);
    EXPECT_EQ(difference(world), "");
}

TEST(WorldRoom, WhatSomebodyHeldWhoLeftIsFree) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, anna);
    EXPECT_EQ(grab(world, anna, brick), Refusal::none);
    anna.leave();
    EXPECT_TRUE(world.until([&] { return holder(ben, brick) == ParticipantId{}; }));
    EXPECT_EQ(grab(world, ben, brick), Refusal::none);
}

TEST(WorldRoom, MarksAreSeenByAllAndClearedByTheirAuthor) {
    World world;
    Person& anna = world.joined("Anna Berg");
    Person& ben = world.joined("Ben Carlsen");
    const ObjectId first = make_mark(world, anna, {0, 1, 0});
    const ObjectId second = make_mark(world, ben, {0.1, 1, 0});
    ASSERT_NE(first, ObjectId{});
    ASSERT_NE(second, ObjectId{});
    EXPECT_TRUE(world.until([&] { return anna.objects(ObjectKind::mark).size() == 2; }));
    const auto number = [&](ObjectId mark) {
        return session::decode_mark(anna.room().objects.at(mark).properties)->number;
    };
    EXPECT_EQ(number(first), 1);
    EXPECT_EQ(number(second), 2);
    EXPECT_EQ(ask(world, ben, session::request::Remove{first}), Refusal::of_another);
    EXPECT_EQ(grab(world, ben, second), Refusal::mark_stays);
    EXPECT_EQ(ask(world, ben, session::request::ClearMarks{true}), Refusal::role);
    EXPECT_EQ(ask(world, ben, session::request::ClearMarks{}), Refusal::none);
    EXPECT_TRUE(world.until([&] { return anna.objects(ObjectKind::mark).size() == 1; }));
    Person& chief = world.joined("Chief", wire::Role::operator_);
    EXPECT_EQ(ask(world, chief, session::request::ClearMarks{true}), Refusal::none);
    EXPECT_TRUE(world.until([&] { return anna.objects(ObjectKind::mark).empty(); }));
}

TEST(WorldRoom, AnObserverChangesNothing) {
    World world;
    Person& anna = world.joined("Anna");
    Person& otto = world.joined("Otto", wire::Role::observer);
    const ObjectId brick = make_brick(world, anna);
    EXPECT_EQ(make_brick(world, otto), ObjectId{});
    EXPECT_EQ(make_mark(world, otto), ObjectId{});
    EXPECT_EQ(grab(world, otto, brick), Refusal::role);
    wire::PersonPose pose;
    pose.time = otto->now();
    pose.head = wire::PartPose{{0, 1.6f, 0}};
    pose.left_hand = wire::PartPose{{0.2f, 1.2f, 0}};
    pose.calls = true;
    otto->send_pose(pose);
    EXPECT_TRUE(world.until([&] { return anna->poses().contains(otto.number()); }));
    const auto seen = anna->poses().at(otto.number());
    EXPECT_TRUE(seen.head);
    EXPECT_FALSE(seen.left_hand || seen.calls);
}

TEST(WorldRoom, OfTwoWhoGrabAtOnceOneHolds) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    ben.path().delay = 300ms;  // of the connections to come
    ben.join();
    EXPECT_TRUE(world.until([&] { return ben.is_in(); }));
    const ObjectId brick = make_brick(world, anna);
    EXPECT_TRUE(world.until([&] { return ben.room().objects.contains(brick); }));
    // Both see it at once as theirs; the nearer one is first at the host.
    ben->ask_room(session::request::Grab{brick});
    anna->ask_room(session::request::Grab{brick});
    EXPECT_EQ(holder(ben, brick), ben.number());
    EXPECT_EQ(holder(anna, brick), anna.number());
    world.advance(2s);
    EXPECT_EQ(holder(ben, brick), anna.number());
    EXPECT_EQ(holder(anna, brick), anna.number());
    const auto refused = ben->take_room_refusal();
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->second, Refusal::held_by_another);
}

TEST(WorldRoom, TheRoomIsThereAfterTheHostsRestart) {
    World world;
    Person& anna = world.joined("Anna Berg");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, anna, {1, 2, 3});
    EXPECT_NE(make_mark(world, anna), ObjectId{});
    EXPECT_EQ(grab(world, anna, brick), Refusal::none);
    world.restart_host();
    EXPECT_EQ(anna->status().phase, client::Participant::Phase::ended);
    anna.join();
    ben.join();
    EXPECT_TRUE(world.until([&] { return anna.is_in() && ben.is_in(); }));
    EXPECT_TRUE(world.until([&] { return ben.sees().size() == 2; }));
    EXPECT_EQ(ben.objects(ObjectKind::brick).size(), 1u);
    EXPECT_EQ(ben.objects(ObjectKind::mark).size(), 1u);
    EXPECT_EQ(holder(ben, brick), ParticipantId{});
    EXPECT_EQ(ben.room().objects.at(brick).room_from_object.translation.z, 3);
    EXPECT_EQ(difference(world), "");
}

}  // namespace
}  // namespace theatron::world
