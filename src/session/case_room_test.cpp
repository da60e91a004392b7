// SPDX-License-Identifier: Apache-2.0
// A case in the room, over messages: a host's and two members' halves.
#include <gtest/gtest.h>

#include "session/room_members_testing.h"

namespace theatron::session {
namespace {

constexpr ParticipantId anna{1}, ben{2}, observer{3};

CaseFacts liver(std::uint8_t number, std::size_t parts = 3) {
    CaseFacts facts;
    facts.id.bytes[0] = std::byte(number);
    facts.name = "liver";
    facts.opacities.assign(parts, 255);
    facts.opacities[0] = 90;
    facts.screen = CaseScreen{facts.id, 0, 0, 12.5, 40, 400};
    return facts;
}

class CaseInRoom : public RoomMembers {
protected:
    CaseInRoom() {
        host.set_cases({liver(1), liver(2, 5)});
        join(anna, Role::expert);
        join(ben, Role::expert);
        join(observer, Role::observer);
    }
    Refusal open(ParticipantId by, const CaseFacts& facts, const Pose& place = {}) {
        return ask(by, request::Create{ObjectKind::organ, place, 1,
                                       encode_case_object(CaseOrgan{facts.id})});
    }
    // The objects of the case as this member sees them.
    RoomObjects of_case(ParticipantId member) {
        RoomObjects found = members[member].objects();
        std::erase_if(found, [](const auto& o) { return o.second.kind == ObjectKind::person; });
        return found;
    }
    ObjectId organ() { return of_case(anna).begin()->first; }
};

TEST_F(CaseInRoom, IsOpenedWholeForEverybody) {
    const Pose place{{}, {0.2, 1.3, -0.4}};
    ASSERT_EQ(open(anna, liver(1), place), Refusal::none);
    for (const ParticipantId member : {anna, ben, observer}) {
        const RoomObjects all = of_case(member);
        ASSERT_EQ(all.size(), 6u);
        const RoomObject& organ = all.begin()->second;
        EXPECT_TRUE(decode_as<CaseOrgan>(organ.kind, organ.properties));
        EXPECT_EQ(organ.room_from_object, place);
        const RoomObject& shell = std::next(all.begin())->second;
        EXPECT_EQ(decode_as<CasePart>(shell.kind, shell.properties)->opacity, 90);
        EXPECT_EQ(shell.room_from_object, Pose{}) << "of the organ";
        const RoomObject& screen = all.rbegin()->second;
        EXPECT_EQ(decode_as<CaseScreen>(screen.kind, screen.properties)->position_mm, 12.5);
    }
}

TEST_F(CaseInRoom, HasTheNameUnderWhichItWasOpened) {
    CaseFacts second = liver(2);
    second.name = "liver (2)";
    host.set_cases({liver(1), second});
    ASSERT_EQ(open(anna, second), Refusal::none);
    EXPECT_EQ(case_in_room(members[observer].objects())->name, "liver (2)");
    second.name = "another";
    host.set_cases({second});
    EXPECT_EQ(case_in_room(members[ben].objects())->name, "liver (2)") << "all agreed on this one";
    ObjectId named{};
    for (const auto& [id, object] : of_case(anna))
        if (decode_as<CaseName>(object.kind, object.properties))
            named = id;
    EXPECT_EQ(
        ask(anna,
            request::SetProperties{named, encode_case_object(CaseName{second.id, "liver (1)"})}),
        Refusal::malformed);
    EXPECT_EQ(ask(anna, request::Remove{named}), Refusal::part_of_case);
    EXPECT_EQ(case_in_room(members[ben].objects())->name, "liver (2)");
}

TEST_F(CaseInRoom, OfARoomWithoutNamesIsReadWithoutOne) {
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    RoomObjects older = members[anna].objects();
    std::erase_if(older, [](const auto& o) {
        return decode_as<CaseName>(o.second.kind, o.second.properties).has_value();
    });
    const auto found = case_in_room(older);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->name, "");
    EXPECT_EQ(found->parts.size(), 3u);
    EXPECT_TRUE(found->screen);
}

TEST_F(CaseInRoom, AnotherOneReplacesItEvenIfSomebodyHoldsIt) {
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    ASSERT_EQ(ask(anna, request::Grab{organ()}), Refusal::none);
    ASSERT_EQ(open(ben, liver(2)), Refusal::none);
    const RoomObjects all = of_case(anna);
    EXPECT_EQ(all.size(), 8u);
    for (const auto& [id, object] : all)
        EXPECT_EQ(object.grip, Grip{});
    EXPECT_EQ(hash_of(members[anna].objects()), hash_of(members[ben].objects()));
}

TEST_F(CaseInRoom, IsClosedWithAllItsObjects) {
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    EXPECT_EQ(ask(ben, request::Remove{organ()}), Refusal::none);
    EXPECT_TRUE(of_case(anna).empty());
    EXPECT_TRUE(of_case(observer).empty());
}

TEST_F(CaseInRoom, APartIsHiddenNotRemoved) {
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    const ObjectId shell = std::next(of_case(anna).begin())->first;
    EXPECT_EQ(ask(anna, request::Remove{shell}), Refusal::part_of_case);
    EXPECT_EQ(of_case(ben).size(), 6u);
    EXPECT_EQ(
        ask(anna,
            request::SetProperties{shell, encode_case_object(CasePart{liver(1).id, 0, false, 90})}),
        Refusal::none);
    const RoomObject hidden = of_case(ben).at(shell);
    EXPECT_FALSE(decode_as<CasePart>(hidden.kind, hidden.properties)->shown);
}

TEST_F(CaseInRoom, AnObjectStaysWhatItIs) {
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    const RoomObjects before = host.snapshot().objects;
    const ObjectId shell = std::next(of_case(anna).begin())->first;
    const ObjectId screen = of_case(anna).rbegin()->first;
    CaseScreen beyond{liver(1).id};
    beyond.width = 0;
    for (const auto& [object, properties] :
         {std::pair{shell, encode_case_object(CasePart{liver(1).id, 1, true, 9})},
          std::pair{shell, encode_case_object(CasePart{liver(2).id, 0, true, 9})},
          std::pair{shell, encode_case_object(CaseOrgan{liver(1).id})},
          std::pair{organ(), Bytes(3)}, std::pair{screen, encode_case_object(beyond)}})
        EXPECT_EQ(ask(anna, request::SetProperties{object, properties}), Refusal::malformed);
    EXPECT_EQ(ask(anna,
                  request::Create{
                      ObjectKind::screen, {}, 1, encode_case_object(CaseScreen{liver(1).id})}),
              Refusal::malformed);
    EXPECT_EQ(ask(anna, request::Create{ObjectKind::organ, {}, 1, Bytes(40)}), Refusal::malformed);
    EXPECT_EQ(hash_of(host.snapshot().objects), hash_of(before));
}

TEST_F(CaseInRoom, OnlyOfferedCasesAreOpenedAndOnlyByThoseWhoMay) {
    EXPECT_EQ(open(anna, liver(9)), Refusal::no_such_object);
    EXPECT_EQ(open(observer, liver(1)), Refusal::role);
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    EXPECT_EQ(ask(observer, request::Remove{organ()}), Refusal::role);
    EXPECT_EQ(of_case(anna).size(), 6u);
}

TEST_F(CaseInRoom, SurvivesARestartOfTheHost) {
    ASSERT_EQ(open(anna, liver(1), {{}, {1, 2, 3}}), Refusal::none);
    ASSERT_EQ(
        ask(anna,
            request::SetProperties{organ(), encode_case_object(CaseOrgan{liver(1).id, 100, true})}),
        Refusal::none);
    std::vector<Action> later_actions;
    HostRoom later(host.snapshot(), later_actions);
    const RoomObjects objects = later.snapshot().objects;
    const RoomObject& organ_object = objects.begin()->second;
    const auto organ = decode_as<CaseOrgan>(organ_object.kind, organ_object.properties);
    ASSERT_TRUE(organ);
    EXPECT_EQ(organ->explosion, 100);
    EXPECT_TRUE(organ->cut);
    EXPECT_EQ(organ_object.room_from_object.translation, (Vec3{1, 2, 3}));
}

TEST_F(CaseInRoom, APresenterAloneChangesTheScreen) {
    const ParticipantId chief{4};
    join(chief, Role::operator_);
    ASSERT_EQ(open(anna, liver(1)), Refusal::none);
    const ObjectId screen = of_case(anna).rbegin()->first;
    const auto now = [&] {
        const RoomObject object = of_case(ben).at(screen);
        return *decode_as<CaseScreen>(object.kind, object.properties);
    };
    const auto change = [&](ParticipantId by, double position_mm, ParticipantId presenter) {
        CaseScreen next = now();
        next.position_mm = position_mm;
        next.presenter = presenter;
        return ask(by, request::SetProperties{screen, encode_case_object(next)});
    };
    const ParticipantId nobody{};
    EXPECT_EQ(change(anna, 1, nobody), Refusal::none);
    EXPECT_EQ(change(ben, 2, nobody), Refusal::none);
    EXPECT_EQ(change(ben, 3, anna), Refusal::held_by_another) << "nobody presents for another";
    EXPECT_EQ(change(anna, 4, anna), Refusal::none);
    EXPECT_EQ(change(ben, 5, anna), Refusal::held_by_another);
    EXPECT_EQ(change(ben, 5, ben), Refusal::held_by_another);
    EXPECT_EQ(change(ben, 5, nobody), Refusal::held_by_another);
    EXPECT_EQ(change(anna, 6, anna), Refusal::none);
    EXPECT_EQ(change(chief, 7, anna), Refusal::none) << "operators may";
    EXPECT_EQ(now().position_mm, 7);
    // It ends with the presenter, with the right to handle, and with the host's run.
    std::vector<Action> later_actions;
    const HostRoom later(host.snapshot(), later_actions);
    const RoomObjects objects = later.snapshot().objects;
    const RoomObject& object = objects.at(screen);
    EXPECT_EQ(decode_as<CaseScreen>(object.kind, object.properties)->presenter, nobody);
    host.set_person(anna, {Role::observer, false, "Anna"});
    deliver();
    EXPECT_EQ(now().presenter, nobody);
    host.set_person(anna, {Role::expert, false, "Anna"});
    deliver();
    EXPECT_EQ(change(anna, 8, anna), Refusal::none);
    host.leave(anna);
    members.erase(anna);
    deliver();
    EXPECT_EQ(now().presenter, nobody);
    EXPECT_EQ(now().position_mm, 8);
    EXPECT_EQ(change(ben, 9, ben), Refusal::none);
}

TEST(CaseObjects, AreReadAsTheyWereWrittenAndNothingElseIs) {
    const ContentHash id = liver(7).id;
    for (const CaseObject& object :
         {CaseObject(CaseOrgan{id, 12, true}), CaseObject(CasePart{id, 255, false, 7}),
          CaseObject(CaseScreen{id, 15, 2, -1234.5, 60, 1500}),
          CaseObject(CaseScreen{id, 15, 2, -1234.5, 60, 1500, 63}),
          CaseObject(CaseScreen{id, 15, 2, -1234.5, 60, 1500, std::nullopt, ben}),
          CaseObject(CaseName{id, "Leber (2)"})}) {
        const auto kind =
            std::holds_alternative<CaseScreen>(object) ? ObjectKind::screen : ObjectKind::organ;
        Bytes bytes = encode_case_object(object);
        EXPECT_EQ(decode_case_object(kind, bytes), object);
        EXPECT_FALSE(decode_case_object(ObjectKind::brick, bytes));
        EXPECT_FALSE(decode_case_object(
            kind == ObjectKind::organ ? ObjectKind::screen : ObjectKind::organ, bytes));
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(decode_case_object(kind, ByteView(bytes).first(size)));
        bytes.push_back({});
        EXPECT_FALSE(decode_case_object(kind, bytes));
    }
    EXPECT_FALSE(
        decode_case_object(ObjectKind::organ, encode_case_object(CasePart{id, 256, true, 7})));
    for (const char* unfit : {"", " liver", "li\nver", "\xff"})
        EXPECT_FALSE(
            decode_case_object(ObjectKind::organ, encode_case_object(CaseName{id, unfit})));
    CaseScreen screen{id};
    EXPECT_EQ(encode_case_object(screen)[0], std::byte(3)) << "as older programs have it";
    screen.picture = 64;
    EXPECT_FALSE(decode_case_object(ObjectKind::screen, encode_case_object(screen)));
}

}  // namespace
}  // namespace theatron::session
