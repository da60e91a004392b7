// SPDX-License-Identifier: Apache-2.0
// Roles, and what operators decide on people.
#include <gmock/gmock.h>

#include "wire/protocol.h"
#include "world/acts.h"

namespace theatron::world {
namespace {

using Phase = client::Participant::Phase;
using wire::ManageAction;
using wire::ManageRefusal;
using wire::Role;

// The host's answer.
ManageRefusal decide(World& world, Person& by, ManageAction action, ParticipantId person,
                     Role role = {}) {
    const std::uint32_t number = by->manage(action, person, role);
    EXPECT_NE(number, 0u);
    std::optional<wire::Managed> answer;
    EXPECT_TRUE(world.until([&] {
        answer = by->take_managed();
        return answer && answer->number == number;
    }));
    return answer ? answer->refusal : ManageRefusal{};
}

TEST(WorldPeople, WhoMustAskWaitsUntilAnOperatorDecides) {
    World world;
    world.options.asks = true;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.person("Anna");
    Person& otto = world.person("Otto");
    anna.options.person =
        Bytes(wire::person_id_size, std::byte(9));  // by which the host knows her again
    anna.join();
    otto.join(Role::observer);
    EXPECT_TRUE(world.until([&] { return chief->visitors().size() == 2; }));
    EXPECT_EQ(anna->status().phase, Phase::waiting);
    world.advance(1s);
    EXPECT_EQ(world.host().participants(), 1u);
    EXPECT_TRUE(anna->room().objects.empty());
    const auto visitor = [&](const std::string& name) {
        for (const wire::Visitor& one : chief->visitors())
            if (one.name == name)
                return one.participant;
        return ParticipantId{};
    };
    EXPECT_EQ(decide(world, chief, ManageAction::admit, visitor("Anna")), ManageRefusal::none);
    EXPECT_EQ(decide(world, chief, ManageAction::turn_away, visitor("Otto")), ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return anna.is_in(); }));
    EXPECT_TRUE(world.until([&] { return otto->status().phase == Phase::refused; }));
    EXPECT_TRUE(chief->visitors().empty());
    // A person who was let in once comes back without asking again.
    anna.path().reset();
    EXPECT_TRUE(world.until([&] { return anna.is_in() && anna->status().joins == 2; }));
}

TEST(WorldPeople, TheFaceOfAPersonWhoBecomesAnObserverIsSeenNoMore) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.joined("Anna");
    wire::FaceExpression smile;
    smile.time = anna->now();
    smile.state = wire::FaceExpression::State::tracked;
    smile.emotions[2] = 1;
    anna->send_expression(smile);
    EXPECT_TRUE(world.until([&] { return chief->expressions().contains(anna.number()); }));
    EXPECT_EQ(decide(world, chief, ManageAction::set_role, anna.number(), Role::observer),
              ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return chief->expressions().empty(); }, 1s));
    Person& ben = world.joined("Ben");
    world.advance(2s);
    EXPECT_TRUE(ben->expressions().empty());
}

TEST(WorldPeople, TheMutedAreNotHeard) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& ben = world.person("Ben");
    int heard = 0;
    ben.options.voice = [&](ParticipantId, ByteView) { ++heard; };
    (void)world.joined("Ben");
    Person& anna = world.joined("Anna");
    const Bytes packet(40, std::byte(7));
    const auto speak = [&] {
        const int before = heard;
        anna->send_voice(packet);
        world.advance(500ms);
        return heard - before;
    };
    EXPECT_EQ(speak(), 1);
    EXPECT_EQ(decide(world, chief, ManageAction::mute, anna.number()), ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return anna->status().standing.muted; }));
    EXPECT_EQ(speak(), 0);
    EXPECT_EQ(decide(world, chief, ManageAction::unmute, anna.number()), ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return !anna->status().standing.muted; }));
    EXPECT_EQ(speak(), 1);
}

TEST(WorldPeople, ARoleThatIsTakenAwayTakesWhatItHolds) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.joined("Anna");
    const auto brick = make_brick(world, anna);
    EXPECT_EQ(grab(world, anna, brick), session::Refusal::none);
    EXPECT_EQ(decide(world, chief, ManageAction::set_role, anna.number(), Role::observer),
              ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return anna->status().standing.role == Role::observer; }));
    EXPECT_TRUE(world.until([&] { return holder(chief, brick) == ParticipantId{}; }));
    EXPECT_EQ(grab(world, anna, brick), session::Refusal::role);
    EXPECT_EQ(decide(world, chief, ManageAction::set_role, anna.number(), Role::expert),
              ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return anna->status().standing.role == Role::expert; }));
    EXPECT_EQ(grab(world, anna, brick), session::Refusal::none);
    EXPECT_EQ(difference(world), "");
}

TEST(WorldPeople, WhoIsRemovedStaysOut) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.person("Anna");
    anna.options.person = Bytes(wire::person_id_size, std::byte(9));
    (void)world.joined("Anna");
    EXPECT_EQ(decide(world, chief, ManageAction::remove, anna.number()), ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return anna->status().phase == Phase::refused; }));
    EXPECT_TRUE(world.until([&] { return chief.sees().size() == 1; }));
    anna.join();
    EXPECT_TRUE(world.until([&] { return anna->status().phase == Phase::refused; }));
    EXPECT_FALSE(anna.is_in());
}

TEST(WorldPeople, OnlyOperatorsDecide) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    EXPECT_NE(decide(world, anna, ManageAction::mute, ben.number()), ManageRefusal::none);
    EXPECT_NE(decide(world, anna, ManageAction::remove, ben.number()), ManageRefusal::none);
    world.advance(2s);
    EXPECT_TRUE(ben.is_in());
    EXPECT_FALSE(ben->status().standing.muted);
}

TEST(WorldPeople, AFormerOperatorNoLongerKnowsWhoWaits) {
    World world;
    world.options.asks = true;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& deputy = world.joined("Deputy", Role::operator_);
    world.person("Anna").join();
    EXPECT_TRUE(world.until([&] { return deputy->visitors().size() == 1; }));
    EXPECT_EQ(decide(world, chief, ManageAction::set_role, deputy.number(), Role::expert),
              ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return deputy->status().standing.role == Role::expert; }));
    EXPECT_TRUE(deputy->visitors().empty());
    EXPECT_EQ(chief->visitors().size(), 1u);
}

TEST(WorldPeople, ARevokedLinkRemovesAllWhoCameByIt) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.joined("Anna");
    Person& otto = world.joined("Otto", Role::observer);
    const std::string expert = world.link(Role::expert);
    EXPECT_EQ(decide(world, chief, ManageAction::revoke_link, anna.number()), ManageRefusal::none);
    EXPECT_TRUE(world.until([&] { return anna->status().phase == Phase::refused; }));
    EXPECT_TRUE(world.until([&] { return chief.sees().size() == 2; }));
    EXPECT_TRUE(otto.is_in());
    // The link stays invalid after a restart.
    const net::Link revoked = net::parse_link(expert);
    world.restart_host();
    EXPECT_NE(net::parse_link(world.link(Role::expert)).token, revoked.token);
}

TEST(WorldPeople, AnOperatorEndsTheSessionForAll) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.joined("Anna");
    EXPECT_NE(chief->manage(ManageAction::end_session), 0u);
    EXPECT_TRUE(world.until([&] { return anna->status().phase == Phase::ended; }));
    EXPECT_TRUE(world.until([&] { return chief->status().phase == Phase::ended; }));
    EXPECT_TRUE(world.until([&] { return world.host().figures().has_ended; }));
}

}  // namespace
}  // namespace theatron::world
