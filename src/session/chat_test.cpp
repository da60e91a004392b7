// SPDX-License-Identifier: Apache-2.0
// Messages of people to all others, and raised hands: from the message to the others.
#include <gtest/gtest.h>

#include "session/host_session_testing.h"
#include "session/raised_hands.h"
#include "session/room_bytes.h"

namespace theatron::session {
namespace {

class Chat : public Host {
protected:
    Chat() {
        HostSession::Config with = config();
        with.admission.tokens.push_back({"watch", Role::observer, {}});
        with.admission.tokens.push_back({"lead", Role::operator_, {}});
        host.emplace(std::move(with));
    }
    void come(ParticipantId id, const char* token, std::uint64_t run = 0, bool has_chat = true) {
        host->on_connected(id, now);
        wire::Join hello;
        hello.token = token;
        hello.name = "person " + std::to_string(std::uint32_t(id));
        hello.depth_codec = "trvl";
        hello.color_codec = "jpeg";
        hello.features = {wire::Feature::room};
        if (has_chat)
            hello.features.push_back(wire::Feature::chat);
        hello.run = run ? run : 100 + std::uint64_t(id);
        say(id, hello);
    }
    void say(ParticipantId id, const wire::ToHost& message) {
        host->on_control(id, wire::encode(message), now);
    }
    // The texts that a participant is told in these actions.
    static std::vector<std::string> texts(ParticipantId id, const std::vector<Action>& actions) {
        std::vector<std::string> texts;
        for (const auto& part : messages_to<wire::ChatMessages>(id, actions))
            for (const wire::ChatMessage& message : part.messages)
                texts.push_back(message.text);
        return texts;
    }
    std::vector<std::string> raised() const {
        std::vector<std::string> names;
        for (const auto& hand : RaisedHands().take(host->room().snapshot().objects))
            names.push_back(hand.name);
        return names;
    }

    using Texts = std::vector<std::string>;
    std::optional<HostSession> host;
};

TEST_F(Chat, GoesToAllWhoShowItAlsoToItsAuthor) {
    come(alice, "secret");
    come(bob, "watch");
    come(carol, "secret", 0, false);
    (void)host->take_actions();
    say(alice, wire::WriteChat{7, "  Please move the camera "});
    const auto actions = host->take_actions();
    EXPECT_EQ(texts(alice, actions), Texts{"Please move the camera"});
    EXPECT_EQ(texts(bob, actions), Texts{"Please move the camera"});
    EXPECT_EQ(texts(carol, actions), Texts{}) << "its program is older";
    const auto told = messages_to<wire::ChatMessages>(bob, actions).at(0).messages.at(0);
    EXPECT_EQ(told, (wire::ChatMessage{7, alice, "person 1", "Please move the camera", now}));
    say(bob, wire::WriteChat{8, "An observer may ask"});
    EXPECT_EQ(texts(alice, host->take_actions()), Texts{"An observer may ask"});
}

TEST_F(Chat, ARepeatedMessageIsTakenOnce) {
    come(alice, "secret");
    come(bob, "secret");
    say(alice, wire::WriteChat{7, "Hello"});
    (void)host->take_actions();
    say(alice, wire::WriteChat{7, "Hello"});
    const auto actions = host->take_actions();
    EXPECT_EQ(texts(alice, actions), Texts{"Hello"}) << "it has waited for that";
    EXPECT_EQ(texts(bob, actions), Texts{});
    say(alice, wire::WriteChat{8, " \t\u200b "});
    EXPECT_EQ(texts(bob, host->take_actions()), Texts{});
}

TEST_F(Chat, TellsAProgramThatComesBackWhatItMissedAndNobodyElseWhatWasBefore) {
    come(alice, "secret");
    come(bob, "secret", 55);
    say(alice, wire::WriteChat{1, "first"});
    host->on_closed(bob);
    say(alice, wire::WriteChat{2, "missed"});
    (void)host->take_actions();
    come(carol, "secret", 55);
    EXPECT_EQ(texts(carol, host->take_actions()), (Texts{"first", "missed"}));
    come(dave, "secret", 56);
    EXPECT_EQ(texts(dave, host->take_actions()), Texts{});
}

TEST_F(Chat, OfManyMessagesTheNewestAreKeptAndComeInParts) {
    come(alice, "secret", 55);
    for (std::uint64_t i = 1; i <= HostChat::max_kept + 20; ++i) {
        now += 1s;
        say(alice, wire::WriteChat{i, std::to_string(i)});
    }
    (void)host->take_actions();
    host->on_closed(alice);
    come(bob, "secret", 55);
    const auto actions = host->take_actions();
    EXPECT_EQ(texts(bob, actions).size(), HostChat::max_kept);
    EXPECT_EQ(texts(bob, actions).front(), "21");
    for (const auto& part : messages_to<wire::ChatMessages>(bob, actions))
        EXPECT_LE(part.messages.size(), wire::max_chat_messages);
}

TEST_F(Chat, AVisitorAndAMutedPersonDoNotWrite) {
    come(alice, "lead");
    come(bob, "secret");
    say(alice, wire::Manage{1, wire::ManageAction::mute, bob, {}});
    (void)host->take_actions();
    say(bob, wire::WriteChat{7, "Hello"});
    EXPECT_EQ(texts(alice, host->take_actions()), Texts{});
    say(alice, wire::Manage{2, wire::ManageAction::unmute, bob, {}});
    say(bob, wire::WriteChat{7, "Hello"});
    EXPECT_EQ(texts(alice, host->take_actions()), Texts{"Hello"});
}

TEST_F(Chat, TooManyMessagesAreHeldBackAndAFloodEndsTheConnection) {
    come(alice, "secret");
    come(bob, "secret");
    (void)host->take_actions();
    for (std::uint64_t i = 1; i <= 50; ++i)
        say(alice, wire::WriteChat{i, "text"});
    EXPECT_EQ(texts(bob, host->take_actions()).size(), 10u);
    now += 1s;
    say(alice, wire::WriteChat{20, "text"});
    EXPECT_EQ(texts(bob, host->take_actions()).size(), 1u) << "the author repeats it";
    for (std::uint64_t i = 1; i <= 3000; ++i)
        say(alice, wire::WriteChat{100 + i, "text"});
    EXPECT_EQ(count<action::Close>(host->take_actions()), 1);
}

TEST_F(Chat, AHandIsUpForAllUntilItIsTakenDown) {
    come(alice, "lead");
    come(bob, "watch");
    EXPECT_EQ(raised(), Texts{});
    say(bob, wire::RaiseHand{true});
    EXPECT_EQ(raised(), Texts{"person 2"});
    say(bob, wire::RaiseHand{false});
    EXPECT_EQ(raised(), Texts{});
    say(bob, wire::RaiseHand{true});
    say(alice, wire::Manage{1, wire::ManageAction::lower_hand, bob, {}});
    EXPECT_EQ(raised(), Texts{}) << "an operator has taken it down";
    say(bob, wire::RaiseHand{true});
    say(bob, wire::Manage{1, wire::ManageAction::lower_hand, bob, {}});
    EXPECT_EQ(raised(), Texts{"person 2"}) << "an observer decides on nobody";
    host->on_closed(bob);
    EXPECT_EQ(raised(), Texts{});
}

TEST_F(Chat, AMutedPersonMayRaiseAHand) {
    come(alice, "lead");
    come(bob, "secret");
    say(alice, wire::Manage{1, wire::ManageAction::mute, bob, {}});
    say(bob, wire::RaiseHand{true});
    EXPECT_EQ(raised(), Texts{"person 2"});
}

TEST(RaisedHands, TellsEachHandOnceAndKeepsTheOrder) {
    RoomObjects objects;
    const auto set = [&](std::uint32_t person, bool up) {
        RoomObject object;
        object.kind = ObjectKind::person;
        object.creator = ParticipantId{person};
        PersonFacts facts;
        facts.name = std::to_string(person);
        facts.hand_raised = up;
        object.properties = encode_person(facts);
        objects[ObjectId{person}] = object;
    };
    RaisedHands hands;
    set(5, true);
    set(2, false);
    ASSERT_EQ(hands.take(objects).size(), 1u);
    set(2, true);
    const auto news = hands.take(objects);
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0].name, "2");
    ASSERT_EQ(hands.raised().size(), 2u);
    EXPECT_EQ(hands.raised()[0].name, "5") << "it was raised first";
    set(5, false);
    EXPECT_TRUE(hands.take(objects).empty());
    EXPECT_EQ(hands.raised().size(), 1u);
}

}  // namespace
}  // namespace theatron::session
