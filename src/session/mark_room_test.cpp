// SPDX-License-Identifier: Apache-2.0
// Marks in the room, over messages: a host's and members' halves.
#include <gtest/gtest.h>

#include "session/mark.h"
#include "session/mark_rules.h"
#include "session/room_members_testing.h"

namespace theatron::session {
namespace {

constexpr ParticipantId anna{1}, ben{2}, observer{3}, chief{4};

class MarksInRoom : public RoomMembers {
protected:
    MarksInRoom() {
        CaseFacts liver;
        liver.opacities.assign(2, 255);
        liver.screen = CaseScreen{};
        host.set_cases({liver});
        join(anna, Role::expert, "Anna Lind");
        join(ben, Role::expert, "Ben");
        join(observer, Role::observer, "Cleo");
        join(chief, Role::operator_, "Dora Oe");
    }
    void join(ParticipantId id, Role role, const std::string& name, const Bytes& person = {}) {
        names[id] = name;
        RoomMembers::join(id, role, name, person);
    }
    Mark pin(ParticipantId by) {
        Mark mark;
        mark.kind = MarkKind::pin;
        mark.color = color_number(by);
        mark.initials = initials_of(names[by]);
        mark.number = 900;
        mark.points = {{{0, 1, 0}, {0, 1, 0}}};
        return mark;
    }
    Mark stroke(ParticipantId by, std::size_t points) {
        Mark mark = pin(by);
        mark.kind = MarkKind::stroke;
        mark.number = 0;
        mark.points.assign(points, mark.points[0]);
        return mark;
    }
    Refusal make(ParticipantId by, const Mark& mark, const Pose& place = {}) {
        return ask(by, request::Create{ObjectKind::mark, place, 1, encode_mark(mark)});
    }
    void open_case() {
        ASSERT_EQ(
            ask(anna,
                request::Create{
                    ObjectKind::organ, {}, 1, encode_case_object(CaseOrgan{host.cases()[0].id})}),
            Refusal::none);
    }
    // Equal for all members, or the test fails.
    std::map<ObjectId, RoomObject> marks() {
        std::map<ObjectId, RoomObject> seen = members[anna].objects();
        for (auto& [id, member] : members) {
            EXPECT_EQ(hash_of(member.objects()), hash_of(host.snapshot().objects));
            EXPECT_EQ(hash_of(member.objects()), hash_of(member.confirmed()));
        }
        std::erase_if(seen, [](const auto& o) { return o.second.kind != ObjectKind::mark; });
        return seen;
    }
    ObjectId first(ObjectKind kind) {
        for (const auto& [id, object] : members[anna].objects())
            if (object.kind == kind)
                return id;
        return {};
    }

    std::map<ParticipantId, std::string> names;
};

TEST_F(MarksInRoom, AreSeenByAllWithTheirAuthorAndPinsAreNumberedByTheHost) {
    EXPECT_EQ(make(anna, pin(anna)), Refusal::none);
    EXPECT_EQ(make(ben, pin(ben)), Refusal::none);
    const auto all = marks();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all.begin()->second.creator, anna);
    const auto first = decode_mark(all.begin()->second.properties),
               second = decode_mark(all.rbegin()->second.properties);
    EXPECT_EQ(first->number, 1);
    EXPECT_EQ(first->initials, "AL");
    EXPECT_EQ(second->number, 2);
    EXPECT_EQ(second->initials, "B");
}

TEST_F(MarksInRoom, ObserversMakeNone) {
    EXPECT_EQ(make(observer, pin(observer)), Refusal::role);
    EXPECT_EQ(ask(observer, request::ClearMarks{}), Refusal::role);
    EXPECT_TRUE(marks().empty());
}

TEST_F(MarksInRoom, AMarkInTheNameOfSomebodyElseIsRefused) {
    Mark mark = pin(anna);
    mark.color = color_number(ben);
    EXPECT_EQ(make(anna, mark), Refusal::of_another);
    mark = pin(anna);
    mark.initials = "B";
    EXPECT_EQ(make(anna, mark), Refusal::of_another);
    EXPECT_TRUE(marks().empty());
}

TEST_F(MarksInRoom, WhatIsNoMarkOrHasItsOwnPlaceIsRefused) {
    EXPECT_EQ(ask(anna, request::Create{ObjectKind::mark, {}, 1, Bytes(20)}), Refusal::malformed);
    EXPECT_EQ(make(anna, stroke(anna, most_mark_points + 1)), Refusal::malformed);
    EXPECT_EQ(make(anna, pin(anna), {{}, {1, 0, 0}}), Refusal::malformed);
    EXPECT_EQ(make(anna, stroke(anna, most_mark_points)), Refusal::none);
    EXPECT_EQ(marks().size(), 1u);
}

TEST_F(MarksInRoom, StickToSurfacesThatAreThere) {
    Mark mark = pin(anna);
    mark.surface = MarkedSurface::organ;
    mark.object = 77;
    EXPECT_EQ(make(anna, mark), Refusal::no_such_object);
    open_case();
    mark.object = std::uint32_t(first(ObjectKind::screen));
    EXPECT_EQ(make(anna, mark), Refusal::no_such_object) << "a screen is no organ";
    mark.surface = MarkedSurface::slice;
    EXPECT_EQ(make(anna, mark), Refusal::none);
    mark.surface = MarkedSurface::organ;
    mark.object = std::uint32_t(first(ObjectKind::organ));
    EXPECT_EQ(make(anna, mark), Refusal::none);
    EXPECT_EQ(make(anna, pin(anna)), Refusal::none);
    EXPECT_EQ(marks().size(), 3u);
    // With the case go the marks on it; the one on the cloud stays.
    EXPECT_EQ(ask(ben, request::Remove{first(ObjectKind::organ)}), Refusal::none);
    EXPECT_EQ(marks().size(), 1u);
}

TEST_F(MarksInRoom, AreRemovedByTheirAuthorAndByOperators) {
    for (int i = 0; i < 2; ++i)
        ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    const ObjectId one = marks().begin()->first, other = marks().rbegin()->first;
    EXPECT_EQ(ask(ben, request::Remove{one}), Refusal::of_another);
    EXPECT_EQ(ask(anna, request::Remove{one}), Refusal::none);
    EXPECT_EQ(ask(chief, request::Remove{other}), Refusal::none);
    EXPECT_TRUE(marks().empty());
    ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    EXPECT_EQ(decode_mark(marks().begin()->second.properties)->number, 1) << "free again";
}

TEST_F(MarksInRoom, AreClearedAsOnesOwnOrByOperatorsAsAll) {
    ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    ASSERT_EQ(make(anna, stroke(anna, 5)), Refusal::none);
    ASSERT_EQ(make(ben, pin(ben)), Refusal::none);
    EXPECT_EQ(ask(anna, request::ClearMarks{true}), Refusal::role);
    EXPECT_EQ(marks().size(), 3u);
    EXPECT_EQ(ask(anna, request::ClearMarks{}), Refusal::none);
    ASSERT_EQ(marks().size(), 1u);
    EXPECT_EQ(marks().begin()->second.creator, ben);
    ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    EXPECT_EQ(ask(chief, request::ClearMarks{true}), Refusal::none);
    EXPECT_TRUE(marks().empty());
}

TEST_F(MarksInRoom, AreNeitherHeldNorChanged) {
    ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    const ObjectId mark = marks().begin()->first;
    EXPECT_EQ(ask(anna, request::Grab{mark}), Refusal::mark_stays);
    EXPECT_EQ(ask(anna, request::SetProperties{mark, encode_mark(stroke(anna, 3))}),
              Refusal::mark_stays);
    EXPECT_EQ(decode_mark(marks().begin()->second.properties)->kind, MarkKind::pin);
}

TEST_F(MarksInRoom, AreLimitedInNumberForOneAuthor) {
    for (std::size_t i = 0; i < max_marks_of_one; ++i)
        ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    EXPECT_EQ(make(anna, pin(anna)), Refusal::too_many);
    EXPECT_EQ(make(ben, pin(ben)), Refusal::none);
}

TEST_F(MarksInRoom, LeaveRoomForOthersAndForTheCase) {
    const std::size_t size = encode_mark(stroke(anna, most_mark_points)).size();
    std::size_t made = 0;
    while (make(anna, stroke(anna, most_mark_points)) == Refusal::none)
        ++made;
    EXPECT_EQ(made, max_mark_bytes_of_one / size);
    EXPECT_EQ(make(ben, stroke(ben, most_mark_points)), Refusal::none);
    for (std::uint32_t other = 10; other < 20; ++other) {
        join(ParticipantId{other}, Role::expert, "Eve");
        while (make(ParticipantId{other}, stroke(ParticipantId{other}, most_mark_points)) ==
               Refusal::none)
            ++made;
    }
    EXPECT_LE((made + 1) * size, max_mark_bytes);
    open_case();
}

TEST_F(MarksInRoom, ArePartOfWhatLatecomersGet) {
    ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    join(ParticipantId{9}, Role::observer, "Late");
    EXPECT_EQ(members[ParticipantId{9}].objects().count(marks().begin()->first), 1u);
}

TEST_F(MarksInRoom, BelongToTheirAuthorAgainWhoComesBack) {
    const Bytes person(16, std::byte(7)), stranger(16, std::byte(8));
    join(ParticipantId{10}, Role::expert, "Eve", person);
    ASSERT_EQ(make(ParticipantId{10}, pin(ParticipantId{10})), Refusal::none);
    host.leave(ParticipantId{10});
    members.erase(ParticipantId{10});
    join(ParticipantId{11}, Role::expert, "Eve", stranger);
    EXPECT_EQ(ask(ParticipantId{11}, request::ClearMarks{}), Refusal::none);
    ASSERT_EQ(marks().size(), 1u);
    join(ParticipantId{12}, Role::expert, "Eve", person);
    EXPECT_EQ(marks().begin()->second.creator, ParticipantId{12});
    EXPECT_EQ(ask(ParticipantId{12}, request::Remove{marks().begin()->first}), Refusal::none);
}

TEST_F(MarksInRoom, HaveNoAuthorAfterARestartBecauseNumbersBeginAgain) {
    ASSERT_EQ(make(anna, pin(anna)), Refusal::none);
    const ObjectId mark = marks().begin()->first;
    HostRoom again(host.snapshot(), actions);
    const RoomObjects objects = again.snapshot().objects;
    ASSERT_EQ(objects.count(mark), 1u);
    EXPECT_EQ(objects.at(mark).creator, ParticipantId{});
    EXPECT_EQ(objects.at(mark).properties, marks().begin()->second.properties);
}

TEST_F(MarksInRoom, BelongToTheirAuthorAgainAfterARestart) {
    const Bytes person(16, std::byte(7)), other(16, std::byte(8));
    const ParticipantId eve{10}, fay{11};
    join(eve, Role::expert, "Eve", person);
    join(fay, Role::expert, "Fay", other);
    ASSERT_EQ(make(eve, pin(eve)), Refusal::none);
    ASSERT_EQ(make(fay, pin(fay)), Refusal::none);
    ASSERT_EQ(make(ben, pin(ben)), Refusal::none) << "without an id of his own";
    HostRoom again(host.snapshot(), actions, host.authors());
    // Numbers of participants begin again: Eve gets one that Anna had, a stranger Eve's.
    const auto number_of = [&](ParticipantId creator) {
        return marks_of(again.snapshot().objects, creator, false).size();
    };
    again.join(eve, {Role::expert, false, "Eve"}, true, {}, Bytes(16, std::byte(9)));
    EXPECT_EQ(number_of(eve), 0u);
    again.join(ben, {Role::expert, false, "Ben"}, true, {}, {});
    EXPECT_EQ(number_of(ben), 0u) << "nobody owns the marks of those without an id";
    again.join(anna, {Role::expert, false, "Eve"}, true, {}, person);
    EXPECT_EQ(number_of(anna), 1u);
    EXPECT_EQ(number_of(fay), 0u);
    actions.clear();
}

TEST(ClearMarks, IsARequestOfTwoBytes) {
    const Bytes all = encode_request(request::ClearMarks{true});
    EXPECT_EQ(all, (Bytes{std::byte(7), std::byte(1)}));
    EXPECT_TRUE(std::get<request::ClearMarks>(*decode_request(all)).of_all);
    EXPECT_FALSE(decode_request(Bytes{std::byte(7), std::byte(2)}));
}

}  // namespace
}  // namespace theatron::session
