// SPDX-License-Identifier: Apache-2.0
// Bricks and marks that people make in the room: how many there can be, and how they are removed.
#include <gtest/gtest.h>

#include "session/host_room.h"
#include "session/mark.h"
#include "wire/control.h"

namespace theatron::session {
namespace {

class RoomAuthors : public ::testing::Test {
protected:
    static Bytes author(int number) { return Bytes(wire::person_id_size, std::byte(number)); }
    // Each time on another connection.
    ParticipantId come(const Bytes& person, const std::string& link, Role role = Role::expert) {
        const ParticipantId id{next_participant_++};
        host_.join(id, {role, false, "Eve"}, true, {}, person, link);
        actions_.clear();
        return id;
    }
    Refusal ask(ParticipantId id, const Request& request) {
        host_.on_request(id, {++number_, encode_request(request)});
        Refusal refusal{99};
        for (const Action& action : actions_)
            if (const auto* sent = std::get_if<action::Send>(&action);
                sent && sent->participant == id)
                if (const auto* decision = std::get_if<wire::RoomDecision>(&sent->message))
                    refusal = Refusal(decision->refusal);
        actions_.clear();
        return refusal;
    }
    Refusal make_brick(ParticipantId id) {
        return ask(id, request::Create{ObjectKind::brick, {}, 1, {}});
    }
    Refusal make_mark(ParticipantId id) {
        Mark mark;
        mark.kind = MarkKind::pin;
        mark.color = color_number(id);
        mark.initials = initials_of("Eve");
        mark.number = 1;
        mark.points = {{{0, 1, 0}, {0, 1, 0}}};
        return ask(id, request::Create{ObjectKind::mark, {}, 1, encode_mark(mark)});
    }
    // How many bricks a new connection of this person makes, until it is refused.
    int make_bricks(const Bytes& person, const std::string& link) {
        const ParticipantId id = come(person, link);
        int made = 0;
        while (made < 3000 && make_brick(id) == Refusal::none)
            ++made;
        host_.leave(id);
        actions_.clear();
        return made;
    }
    int count(ObjectKind kind) const {
        int found = 0;
        for (const auto& [id, object] : host_.snapshot().objects)
            found += object.kind == kind;
        return found;
    }
    void fill() {
        for (int i = 1; i <= 10; ++i)
            make_bricks(author(i), "link " + std::to_string(i));
    }

    std::vector<Action> actions_;
    HostRoom host_{{}, actions_};
    std::uint32_t next_participant_ = 1, number_ = 0;
};

TEST_F(RoomAuthors, OnePersonMakesSoMuchOnHoweverManyConnections) {
    for (int again = 0; again < 5; ++again)
        make_bricks(author(1), "expert");
    EXPECT_EQ(count(ObjectKind::brick), int(RoomState::max_objects_of_one));
    EXPECT_GT(make_bricks(author(2), "expert"), 0) << "somebody else";
}

TEST_F(RoomAuthors, OneLinkBringsNoMoreHoweverManyPeopleComeByIt) {
    for (int i = 1; i <= 20; ++i)
        make_bricks(author(i), "expert");
    EXPECT_EQ(count(ObjectKind::brick), int(HostRoom::max_objects_by_one_link));
    EXPECT_GT(make_bricks(author(50), "other"), 0);
}

TEST_F(RoomAuthors, PlacesAreKeptForCasesAndOperators) {
    CaseFacts liver;
    liver.opacities.assign(2, 255);
    liver.screen = CaseScreen{};
    host_.set_cases({liver});
    fill();
    const ParticipantId guest = come(author(70), "new"),
                        chief = come(author(71), "or", Role::operator_);
    EXPECT_EQ(make_brick(guest), Refusal::too_many);
    EXPECT_EQ(make_mark(guest), Refusal::too_many);
    EXPECT_EQ(make_brick(chief), Refusal::none);
    EXPECT_EQ(make_mark(chief), Refusal::none);
    const auto organ = encode_case_object(CaseOrgan{host_.cases()[0].id});
    EXPECT_EQ(ask(guest, request::Create{ObjectKind::organ, {}, 1, organ}), Refusal::none);
}

TEST_F(RoomAuthors, AnOperatorRemovesWhatAPersonMadeAlsoOnEarlierConnections) {
    const ParticipantId other = come(author(2), "expert");
    ASSERT_EQ(make_brick(other), Refusal::none);
    ASSERT_EQ(make_mark(other), Refusal::none);
    make_bricks(author(1), "expert");
    const ParticipantId eve = come(author(1), "expert");
    ASSERT_EQ(make_mark(eve), Refusal::none);
    EXPECT_GT(host_.clear_of(eve), 500u);
    EXPECT_EQ(count(ObjectKind::brick), 1);
    EXPECT_EQ(count(ObjectKind::mark), 1);
    EXPECT_EQ(host_.clear_of(eve), 0u);
}

TEST_F(RoomAuthors, AlsoOfOneWhoHasLeft) {
    const ParticipantId other = come(author(2), "expert");
    ASSERT_EQ(make_brick(other), Refusal::none);
    make_bricks(author(1), "expert");
    const ParticipantId eve = come(author(1), "expert");
    ASSERT_EQ(make_mark(eve), Refusal::none);
    host_.leave(eve);
    EXPECT_GT(host_.clear_of(eve), 500u);
    EXPECT_EQ(count(ObjectKind::brick), 1);
    // Somebody without an id is known by the connection.
    const ParticipantId nobody = come({}, "expert");
    ASSERT_EQ(make_brick(nobody), Refusal::none);
    host_.leave(nobody);
    EXPECT_EQ(host_.clear_of(nobody), 1u);
    EXPECT_EQ(host_.clear_of(ParticipantId{999}), 0u);
}

TEST_F(RoomAuthors, AfterARestartTheLimitHoldsAndTheObjectsCanBeRemoved) {
    for (int again = 0; again < 2; ++again)
        make_bricks(author(1), "expert");
    const ParticipantId nobody = come({}, "expert");
    ASSERT_EQ(make_brick(nobody), Refusal::none);
    const int before = count(ObjectKind::brick);
    std::vector<Action> actions;
    HostRoom again(host_.snapshot(), actions, host_.authors());
    const ParticipantId eve{1}, chief{2};
    again.join(eve, {Role::expert, false, "Eve"}, true, {}, author(1), "expert");
    again.join(chief, {Role::operator_, false, "Dora"}, true, {}, author(9), "or");
    actions.clear();
    again.on_request(eve, {1, encode_request(request::Create{ObjectKind::brick, {}, 1, {}})});
    const auto& sent = std::get<action::Send>(actions.back());
    EXPECT_EQ(Refusal(std::get<wire::RoomDecision>(sent.message).refusal), Refusal::too_many);
    EXPECT_EQ(again.clear_of(chief), 0u) << "another one had that number before";
    EXPECT_EQ(again.clear_of(eve), std::size_t(before - 1));
    EXPECT_EQ(again.clear_of({}), 1u) << "nobody knows of whom it is";
}

}  // namespace
}  // namespace theatron::session
