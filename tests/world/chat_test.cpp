// SPDX-License-Identifier: Apache-2.0
// Messages of people to all others, and raised hands, over links that break.
#include <gmock/gmock.h>

#include <algorithm>

#include "world/acts.h"

namespace theatron::world {
namespace {

using ::testing::ElementsAre;
using wire::ManageAction;
using wire::Role;

std::vector<std::string> texts(Person& person) {
    std::vector<std::string> texts;
    for (const wire::ChatMessage& message : person->chat().messages)
        texts.push_back(message.name + ": " + message.text);
    return texts;
}

TEST(WorldChat, AllReadWhatIsWrittenInOneOrder) {
    World world;
    Person& anna = world.joined("Anna");
    Person& otto = world.joined("Otto", Role::observer);
    ASSERT_TRUE(world.until([&] { return anna->may_write() && otto->may_write(); }));
    EXPECT_TRUE(anna->write_chat("Please move the camera"));
    EXPECT_TRUE(anna->write_chat("to the left"));
    EXPECT_TRUE(world.until([&] { return texts(otto).size() == 2; }));
    EXPECT_TRUE(otto->write_chat("Done"));
    EXPECT_TRUE(world.until([&] { return texts(anna).size() == 3 && texts(otto).size() == 3; }));
    EXPECT_THAT(texts(anna),
                ElementsAre("Anna: Please move the camera", "Anna: to the left", "Otto: Done"));
    EXPECT_EQ(texts(otto), texts(anna));
    EXPECT_TRUE(otto.was_told("Anna: Please move the camera"));
    EXPECT_FALSE(anna.was_told("Anna: Please move the camera")) << "she knows it";
    // A person who comes later does not read what was written before.
    Person& ben = world.joined("Ben");
    world.advance(2s);
    EXPECT_TRUE(texts(ben).empty());
}

TEST(WorldChat, ALostConnectionLosesNoMessageAndDoublesNone) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.joined("Ben");
    ASSERT_TRUE(world.until([&] { return anna->may_write(); }));
    ben.path().reset();
    for (int i = 0; i < 20; ++i) {
        EXPECT_TRUE(anna->write_chat(std::to_string(i)));
        // The message or its answer is lost with the connection.
        if (i % 3 == 0)
            anna.path().reset();
        world.advance(std::chrono::milliseconds(37 * i % 200));
        EXPECT_TRUE(world.until([&] { return anna->chat().unsent.empty(); }));
    }
    EXPECT_TRUE(world.until([&] { return texts(ben).size() == 20; }));
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(texts(ben).at(std::size_t(i)), "Anna: " + std::to_string(i));
    world.advance(10s);
    EXPECT_EQ(texts(ben).size(), 20u);
    EXPECT_EQ(texts(anna), texts(ben));
}

TEST(WorldChat, AMutedPersonIsToldThatAMessageIsNotSent) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& anna = world.person("Anna");
    anna.options.person =
        Bytes(wire::person_id_size, std::byte(9));  // by which the host knows her again
    anna.join();
    ASSERT_TRUE(world.until([&] { return anna.is_in() && anna->may_write(); }));
    EXPECT_NE(chief->manage(ManageAction::mute, anna.number()), 0u);
    EXPECT_TRUE(world.until([&] { return anna->status().standing.muted; }));
    EXPECT_FALSE(anna->may_write());
    EXPECT_FALSE(anna->write_chat("Hello"));
    EXPECT_NE(chief->manage(ManageAction::unmute, anna.number()), 0u);
    EXPECT_TRUE(world.until([&] { return anna->may_write(); }));
    EXPECT_TRUE(anna->write_chat("Hello"));
    EXPECT_TRUE(world.until([&] { return texts(chief).size() == 1; }));
    // Muted while a message is on its way.
    anna.path().cut();
    EXPECT_TRUE(anna->write_chat("too late"));
    EXPECT_NE(chief->manage(ManageAction::mute, anna.number()), 0u);
    world.advance(1s);
    anna.path().mend();
    EXPECT_TRUE(world.until([&] { return anna->status().standing.muted; }));
    world.advance(5s);
    EXPECT_TRUE(anna->chat().unsent.empty());
    EXPECT_TRUE(anna.was_told("Not sent: too late"));
    EXPECT_EQ(texts(chief).size(), 1u);
}

TEST(WorldChat, ANumberOfTheirOwnTellsAProgramThatComesAgainWhatItMissed) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.person("Ben");
    ben.options.run = 77;
    ben.join();
    ASSERT_TRUE(world.until([&] { return ben.is_in() && anna->may_write(); }));
    EXPECT_TRUE(anna->write_chat("first"));
    EXPECT_TRUE(world.until([&] { return texts(ben).size() == 1; }));
    ben.join();  // another participant of the same program, as a page that changes its view
    EXPECT_TRUE(world.until([&] { return ben.is_in() && texts(ben).size() == 1; }));
}

TEST(WorldChat, WhatSomebodyWroteAndReadGoesOnWithTheNextStayOfTheirRun) {
    World world;
    Person& anna = world.joined("Anna");
    Person& ben = world.person("Ben");
    ben.options.run = 77;
    ben.join();
    ASSERT_TRUE(world.until([&] { return ben.is_in() && ben->may_write() && anna->may_write(); }));
    EXPECT_TRUE(anna->write_chat("read"));
    EXPECT_TRUE(ben->write_chat("mine"));
    EXPECT_TRUE(ben->raise_hand(true));
    EXPECT_TRUE(world.until(
        [&] { return texts(ben).size() == 2 && texts(anna).size() == 2 && ben->hand_raised(); }));
    ben.path().cut();
    EXPECT_TRUE(ben->write_chat("on its way"));
    world.advance(1s);
    // As a page that changes its view.
    ben.options.chat = ben->chat_so_far();
    ben.options.raises_hand = ben->hand_raised();
    ben.path().mend();
    ben.join();
    EXPECT_TRUE(world.until([&] { return texts(anna).size() == 3 && texts(ben).size() == 3; }));
    EXPECT_EQ(texts(anna).back(), "Ben: on its way");
    EXPECT_EQ(texts(ben), texts(anna));
    EXPECT_EQ(ben->chat().own.size(), 2u);
    EXPECT_TRUE(world.until([&] { return ben->hand_raised(); }));
    world.advance(10s);
    EXPECT_EQ(texts(anna).size(), 3u) << "nothing twice";
}

TEST(WorldChat, TheTimesOfMessagesStayWhileTheConnectionIsLost) {
    World world;
    Person& anna = world.joined("Anna");
    ASSERT_TRUE(world.until([&] { return anna->may_write() && anna->status().clock_known; }));
    const TimePoint before = anna->now(), world_before = world.now();
    anna.path().cut();
    ASSERT_TRUE(world.until([&] { return !anna->status().clock_known; }));
    const Duration passed = world.now() - world_before, shown = anna->now() - before;
    EXPECT_LT(std::max(passed, shown) - std::min(passed, shown), 1s);
}

TEST(WorldChat, AMessageThatWaitsForAnEndedSessionIsTold) {
    World world;
    Person& anna = world.joined("Anna");
    ASSERT_TRUE(world.until([&] { return anna->may_write(); }));
    anna.path().cut();
    EXPECT_TRUE(anna->write_chat("never"));
    EXPECT_NE(world.host().link(Role::expert), "");
    world.end_host();
    anna.path().mend();
    EXPECT_TRUE(world.until([&] {
        return anna->status().phase == client::Participant::Phase::ended ||
               anna.was_told("Not sent: never");
    }));
    EXPECT_TRUE(anna.was_told("Not sent: never"));
    EXPECT_FALSE(anna->may_write());
}

TEST(WorldChat, AHandIsSeenByAllAndAnOperatorTakesItDown) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& otto = world.joined("Otto", Role::observer);
    ASSERT_TRUE(world.until([&] { return otto->may_write(); }));
    for (int i = 0; i < 60; ++i)  // more than a host takes at once
        EXPECT_TRUE(otto->raise_hand(i % 2 != 0));
    EXPECT_TRUE(world.until([&] { return chief->raised_hands().size() == 1; }));
    world.advance(10s);
    EXPECT_EQ(chief->raised_hands().size(), 1u);
    otto.path().reset();
    EXPECT_TRUE(world.until([&] { return otto.is_in() && otto->status().joins == 2; }));
    EXPECT_TRUE(world.until([&] { return chief->raised_hands().size() == 1; })) << "it is up again";
    EXPECT_EQ(chief->raised_hands()[0].name, "Otto");
    EXPECT_TRUE(chief.was_told("Otto has raised a hand"));
    EXPECT_TRUE(world.until([&] { return otto->hand_raised(); }));
    EXPECT_FALSE(chief->hand_raised());
    // A person who comes later sees it, too.
    Person& ben = world.joined("Ben");
    EXPECT_TRUE(world.until([&] { return ben->raised_hands().size() == 1; }));
    EXPECT_NE(chief->manage(ManageAction::lower_hand, otto.number()), 0u);
    EXPECT_TRUE(world.until([&] { return !otto->hand_raised() && ben->raised_hands().empty(); }));
}

TEST(WorldChat, AHandThatAnOperatorTakesDownStaysDown) {
    World world;
    Person& chief = world.joined("Chief", Role::operator_);
    Person& otto = world.joined("Otto", Role::observer);
    ASSERT_TRUE(world.until([&] { return otto->may_write(); }));
    EXPECT_TRUE(otto->raise_hand(true));
    EXPECT_TRUE(world.until([&] { return otto->hand_raised(); }));
    EXPECT_NE(chief->manage(ManageAction::lower_hand, otto.number()), 0u);
    EXPECT_TRUE(world.until([&] { return !otto->hand_raised(); }));
    for (int i = 0; i < 100; ++i) {
        world.advance(100ms);
        ASSERT_FALSE(otto->hand_raised()) << i;
    }
    EXPECT_TRUE(otto->raise_hand(true));
    EXPECT_TRUE(world.until([&] { return chief->raised_hands().size() == 1; }));
}

}  // namespace
}  // namespace theatron::world
