// SPDX-License-Identifier: Apache-2.0
// Links that are slow, break, or lead to nobody, and hosts that come and go.
#include <gmock/gmock.h>

#include "world/acts.h"

namespace theatron::world {
namespace {

using Phase = client::Participant::Phase;
using session::ObjectId;
using session::ObjectKind;
using session::Refusal;

TEST(WorldLinks, ABrokenConnectionIsMadeAgain) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, anna);
    EXPECT_EQ(grab(world, anna, brick), Refusal::none);
    const ParticipantId before = anna.number();
    anna.path().reset();
    EXPECT_TRUE(world.until([&] { return anna->status().phase == Phase::lost; }));
    EXPECT_TRUE(world.until([&] { return holder(ben, brick) == ParticipantId{}; }));
    EXPECT_TRUE(world.until([&] { return anna->status().joins == 2 && anna.is_in(); }));
    EXPECT_NE(anna.number(), before);
    world.advance(1s);
    EXPECT_EQ(ben.sees().size(), 2u);
    EXPECT_EQ(difference(world), "");
}

TEST(WorldLinks, AShortSilenceCostsNoConnection) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, ben);
    anna.path().cut();
    EXPECT_EQ(grab(world, ben, brick), Refusal::none);
    world.advance(20s);
    EXPECT_EQ(holder(anna, brick), ParticipantId{});  // it does not know yet
    anna.path().mend();
    EXPECT_TRUE(world.until([&] { return holder(anna, brick) == ben.number(); }, 2s));
    EXPECT_EQ(anna->status().joins, 1);
}

TEST(WorldLinks, ALongSilenceIsTheEndOfAConnection) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, anna);
    EXPECT_EQ(grab(world, anna, brick), Refusal::none);
    anna.path().cut();
    world.advance(40s);
    EXPECT_EQ(holder(ben, brick), ParticipantId{});
    EXPECT_EQ(ben.sees(), std::vector<std::string>{"Ben"});
    EXPECT_EQ(anna->status().phase, Phase::lost);
    anna.path().mend();
    EXPECT_TRUE(world.until([&] { return anna.is_in(); }));
    EXPECT_EQ(world.host().participants(), 2u);
    EXPECT_EQ(anna.path().connections(), 1u);
}

TEST(WorldLinks, ALossHoldsBackButChangesNoOrder) {
    World world(7);
    Person& anna = world.person("Anna");
    anna.path().loss = 0.2;
    anna.path().delay = 150ms;
    (void)world.joined("Anna");
    Person& ben = world.joined("Ben");
    const ObjectId brick = make_brick(world, ben);
    EXPECT_EQ(grab(world, ben, brick), Refusal::none);
    for (int i = 1; i <= 100; ++i) {
        EXPECT_TRUE(ben->move_object(brick, {{}, {0.01 * i, 1, 0}}, 1));
        world.advance(30ms);
    }
    EXPECT_TRUE(world.until([&] {
        return anna.room().objects.at(brick).room_from_object.translation.x == 0.01 * 100;
    }));
    EXPECT_EQ(difference(world), "");
}

TEST(WorldLinks, NobodyAnswersAndThenSomebodyDoes) {
    World world;
    Person& anna = world.joined("Anna");
    anna.path().cut();
    world.advance(31s);
    // The host's goodbye never arrives, as when its machine loses power.
    world.end_host();
    anna.path().mend();
    world.advance(20s);
    EXPECT_EQ(anna->status().phase, Phase::lost);
    EXPECT_FALSE(anna->status().problem.empty());
    (void)world.host();
    EXPECT_TRUE(world.until([&] { return anna.is_in(); }));
    EXPECT_EQ(anna->status().joins, 2);
}

TEST(WorldLinks, TheEndOfASessionIsSaidToAll) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    world.end_host();
    for (Person* person : {&anna, &ben}) {
        EXPECT_EQ((*person)->status().phase, Phase::ended);
        EXPECT_FALSE((*person)->status().problem.empty());
    }
    const auto said = anna.said().size();
    world.advance(1min);
    EXPECT_EQ(anna.said().size(), said);  // and it is not tried again
    EXPECT_EQ(anna.path().connections(), 0u);
}

TEST(WorldLinks, AHostWithAnotherCertificateIsNotTrusted) {
    World world;
    (void)world.host();
    Person& anna = world.person("Anna");
    net::Link link = net::parse_link(world.link(wire::Role::expert));
    link.fingerprint.front() = link.fingerprint.front() == '0' ? '1' : '0';
    anna.join(net::format_link(link));
    EXPECT_TRUE(world.until([&] { return anna->status().phase == Phase::refused; }));
    world.advance(1min);
    EXPECT_EQ(world.host().participants(), 0u);
    EXPECT_EQ(anna.path().connections(), 0u);
}

TEST(WorldLinks, TwoSessionsOfAPortKnowNothingOfEachOther) {
    World world;
    Person& anna = world.joined("Anna");
    auto second = world.further_session("second");
    Person& ben = world.person("Ben");
    ben.join(second->link());
    EXPECT_TRUE(world.until([&] { return ben.is_in(); }));
    EXPECT_EQ(anna.sees(), std::vector<std::string>{"Anna"});
    EXPECT_EQ(ben.sees(), std::vector<std::string>{"Ben"});
    EXPECT_NE(make_brick(world, ben), ObjectId{});
    EXPECT_TRUE(anna.objects(ObjectKind::brick).empty());
    EXPECT_TRUE(world.until([&] { return second->participants() == 1; }));
    EXPECT_EQ(world.host().participants(), 1u);
    second.reset();
    EXPECT_TRUE(world.until([&] { return ben->status().phase == Phase::ended; }));
    world.advance(1min);
    EXPECT_EQ(ben.path().connections(), 0u);
    EXPECT_TRUE(anna.is_in());
    EXPECT_EQ(anna->status().joins, 1);
}

}  // namespace
}  // namespace theatron::world
