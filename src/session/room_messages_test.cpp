// SPDX-License-Identifier: Apache-2.0
// The room over messages: a host's and two members' halves.
#include <gtest/gtest.h>

#include "session/host_room.h"
#include "session/member_room.h"

namespace theatron::session {
namespace {

constexpr ParticipantId anna{1}, ben{2}, recorder{3};

class RoomMessages : public ::testing::Test {
protected:
    RoomMessages() {
        for (const auto& [id, name] : {std::pair{anna, "Anna"}, std::pair{ben, "Ben"}}) {
            members[id].begin(id);
            host.join(id, {Role::expert, false, name}, true);
        }
        deliver();
    }
    // Delivers all messages, until there are no more.
    void deliver() {
        for (bool more = true; std::exchange(more, false);) {
            for (const Action& next : std::exchange(actions, {})) {
                const auto& send = std::get<action::Send>(next);
                ++sent[send.participant];
                if (members.contains(send.participant))
                    members[send.participant].on_message(through_bytes(send.message));
                more = true;
            }
            for (auto& [id, member] : members) {
                for (const wire::RoomRequest& request : member.take_requests()) {
                    host.on_request(id, request);
                    more = true;
                }
                for (const auto& [object, body] : member.take_poses())
                    for (const ParticipantId receiver :
                         host.on_pose(id, {{wire::StateTopic::object, std::uint32_t(object)}, body},
                                      now)
                             .receivers)
                        members[receiver].on_pose(object, body);
            }
        }
    }
    static wire::ToParticipant through_bytes(const wire::ToParticipant& message) {
        const auto decoded = wire::decode_to_participant(wire::encode(message));
        EXPECT_TRUE(decoded);
        return *decoded;
    }
    ObjectId brick(ParticipantId by, std::size_t property_bytes = 3) {
        members[by].ask(request::Create{ObjectKind::brick, {}, 1, Bytes(property_bytes)});
        deliver();
        return host.snapshot().objects.rbegin()->first;
    }
    void expect_the_same() {
        const std::uint64_t hash = hash_of(host.snapshot().objects);
        for (auto& [id, member] : members)
            EXPECT_EQ(hash_of(member.objects()), hash) << int(id);
    }

    std::vector<Action> actions;
    HostRoom host{{}, actions};
    std::map<ParticipantId, MemberRoom> members;
    std::map<ParticipantId, int> sent;
    TimePoint now = TimePoint(1s);
};

TEST_F(RoomMessages, EverybodyIsInItByName) {
    ASSERT_EQ(members[anna].objects().size(), 2u);
    const auto facts = decode_person(members[anna].objects().rbegin()->second.properties);
    EXPECT_EQ(facts->name, "Ben");
    host.join(recorder, {Role::expert, true, "Rec"}, false);
    deliver();
    EXPECT_TRUE(decode_person(members[ben].objects().rbegin()->second.properties)->records);
    EXPECT_EQ(sent[recorder], 0) << "it keeps no room";
    host.leave(recorder);
    deliver();
    EXPECT_EQ(members[ben].objects().size(), 2u);
    EXPECT_FALSE(facts->voice_recorded);
    host.set_person(ben, {Role::expert, false, "Ben", true, true});
    deliver();
    const auto changed = decode_person(members[anna].objects().rbegin()->second.properties);
    EXPECT_TRUE(changed->voice_recorded && changed->muted);
    EXPECT_FALSE(changed->hand_raised);
    host.set_person(ben, {Role::expert, false, "Ben", false, false, true});
    deliver();
    EXPECT_TRUE(decode_person(members[anna].objects().rbegin()->second.properties)->hand_raised);
    expect_the_same();
}

TEST_F(RoomMessages, WhatOneDoesTheOtherSees) {
    const ObjectId object = brick(anna);
    members[anna].ask(request::Grab{object});
    const Pose pose{{}, {1, 2, 3}};
    EXPECT_TRUE(members[anna].move(object, pose, 1, now));
    EXPECT_EQ(members[anna].objects().at(object).room_from_object, pose) << "at once";
    deliver();
    EXPECT_EQ(members[ben].objects().at(object).room_from_object, pose);
    EXPECT_EQ(members[ben].objects().at(object).grip.holder, anna);
    members[ben].ask(request::Grab{object});
    deliver();
    EXPECT_EQ(members[ben].take_refusal()->second, Refusal::held_by_another);
    EXPECT_FALSE(members[ben].take_refusal());
    expect_the_same();
}

TEST_F(RoomMessages, AReplayedRoomIsShownToAllAndChangedByNobody) {
    const ObjectId own = brick(anna);
    RoomObject person{
        ObjectKind::person, ben, {}, {}, {}, 1, encode_person({Role::expert, false, "Eve"})};
    RoomObject organ{ObjectKind::organ, ben, {}, {}, {{}, {1, 1, 1}}, 1, {}};
    RoomObjects recorded{{ObjectId{1}, person}, {own, organ}};
    const auto show = [&] {
        for (const ObjectPose& pose : host.replay(recorded, now))
            for (const ParticipantId receiver : host.receivers())
                members[receiver].on_pose(pose.object, encode_object_pose(pose));
        deliver();
        now += 11ms;
    };
    const auto expect_shown = [&] {
        for (auto& [id, member] : members)
            EXPECT_EQ(hash_of(as_recorded(member.objects())), hash_of(recorded)) << int(id);
    };
    show();
    expect_shown();
    EXPECT_EQ(members[ben].objects().size(), 5u) << "beside those of the session";

    // It is held and moved by a recorded person: only poses come, until it is put down.
    recorded[own].grip = {ben, 7};
    show();
    const int messages = sent[anna];
    for (int i = 0; i < 20; ++i) {
        recorded[own].room_from_object.translation.x += 0.1;
        recorded[own].moved_at = from_us(i);
        show();
        expect_shown();
    }
    EXPECT_EQ(sent[anna], messages);
    recorded[own].grip = {};
    show();
    expect_shown();

    const auto replayed = ObjectId(std::uint32_t(own) | recorded_bit);
    for (const Request& request :
         {Request(request::Grab{replayed}), Request(request::Remove{replayed}),
          Request(request::SetProperties{replayed, Bytes(1)})}) {
        members[anna].ask(request);
        deliver();
        EXPECT_EQ(members[anna].take_refusal()->second, Refusal::recorded);
        expect_shown();
    }
    members[ParticipantId{9}].begin(ParticipantId{9});
    host.join(ParticipantId{9}, {Role::expert, false, "Late"}, true);
    deliver();
    expect_shown();

    const std::uint64_t version = host.version();
    recorded.erase(own);
    show();
    expect_shown();
    EXPECT_EQ(host.version(), version) << "nothing to be saved";
    EXPECT_EQ(host.snapshot().objects.size(), 4u);
    recorded.clear();
    show();
    expect_the_same();
}

TEST_F(RoomMessages, ALargeRoomComesInParts) {
    for (int i = 0; i < 60; ++i)
        brick(i % 2 == 0 ? anna : ben, RoomState::max_property_bytes);
    MemberRoom late;
    late.begin(ParticipantId{9});
    host.join(ParticipantId{9}, {Role::expert, false, "Late"}, true);
    int parts = 0;
    for (const Action& next : actions) {
        const auto& send = std::get<action::Send>(next);
        if (send.participant != ParticipantId{9})
            continue;
        EXPECT_FALSE(late.known());
        late.on_message(through_bytes(send.message));
        ++parts;
    }
    EXPECT_GT(parts, 4);
    EXPECT_EQ(hash_of(late.objects()), hash_of(host.snapshot().objects));
}

TEST_F(RoomMessages, AMissingChangeLeadsToASnapshot) {
    const ObjectId object = brick(anna);
    members[anna].ask(request::Grab{object});
    host.on_request(anna, members[anna].take_requests().at(0));
    std::erase_if(actions, [](const Action& next) {
        return std::get<action::Send>(next).participant == ben;  // its message is lost
    });
    members[anna].ask(request::SetProperties{object, Bytes(5)});
    deliver();
    expect_the_same();
}

TEST_F(RoomMessages, DamageChangesNothing) {
    brick(anna);
    const std::uint64_t hash = hash_of(members[ben].objects());
    const Bytes junk(7, std::byte{0x5a});
    members[ben].on_message(wire::RoomSnapshot{99, 0, 1, junk});
    members[ben].on_message(wire::RoomSnapshot{99, 1, 2, {}});
    members[ben].on_message(wire::RoomChange{host.revision() + 1, 1, junk});
    members[ben].on_pose(ObjectId{1}, junk);
    EXPECT_EQ(hash_of(members[ben].objects()), hash);
    host.on_request(anna, {77, junk});
    deliver();
    EXPECT_EQ(members[anna].take_refusal()->second, Refusal::malformed);
    EXPECT_EQ(hash_of(host.snapshot().objects), hash);
}

TEST_F(RoomMessages, PosesOfTheFutureAndFloodsAreRefused) {
    const ObjectId object = brick(anna);
    members[anna].ask(request::Grab{object});
    deliver();
    members[anna].move(object, {}, 1, now + 2 * HostRoom::max_pose_lead);
    const Bytes body = members[anna].take_poses().at(object);
    const wire::State state{{wire::StateTopic::object, std::uint32_t(object)}, body};
    EXPECT_TRUE(host.on_pose(anna, state, now).receivers.empty());
    bool flood = false;
    for (int i = 0; i < 2000 && !flood; ++i)
        flood = host.on_pose(anna, state, now).is_flood;
    EXPECT_TRUE(flood);
}

TEST_F(RoomMessages, ARequestThatIsNotLookedAtIsDecidedAllTheSame) {
    const ObjectId object = brick(anna);
    members[anna].ask(request::Grab{object});
    host.refuse(anna, members[anna].take_requests().at(0), Refusal::too_often);
    deliver();
    EXPECT_EQ(members[anna].take_refusal()->second, Refusal::too_often);
    EXPECT_EQ(members[anna].objects().at(object).grip.holder, ParticipantId{});
}

TEST(RoomBytes, RequestsComeBackAsTheyWere) {
    const Pose pose{{0.5, 0.5, -0.5, 0.5}, {1, 2, 3}};
    for (const Request& request :
         {Request(request::Create{ObjectKind::mark, pose, 2, Bytes(9)}),
          Request(request::Remove{ObjectId{7}}), Request(request::Grab{ObjectId{8}}),
          Request(request::Release{ObjectId{9}, 4, pose, 3}),
          Request(request::HandOver{ObjectId{9}, 4, ben}),
          Request(request::SetProperties{ObjectId{3}, Bytes(4)})}) {
        const Bytes bytes = encode_request(request);
        const auto back = decode_request(bytes);
        ASSERT_TRUE(back);
        EXPECT_EQ(encode_request(*back), bytes);
        EXPECT_EQ(back->index(), request.index());
        EXPECT_FALSE(decode_request(ByteView(bytes).first(bytes.size() - 1)));
    }
}

}  // namespace
}  // namespace theatron::session
