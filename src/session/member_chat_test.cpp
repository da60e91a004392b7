// SPDX-License-Identifier: Apache-2.0
#include "session/member_chat.h"

#include <gtest/gtest.h>

#include <utility>

namespace theatron::session {
namespace {

constexpr ParticipantId self{1}, anna{2};

wire::ChatMessage message(std::uint64_t id, TimePoint at, ParticipantId from = anna) {
    return {id, from, "Anna", "text " + std::to_string(id), at};
}

TEST(MemberChat, SendsItsMessagesOneAfterTheOtherUntilTheyComeBack) {
    MemberChat chat;
    EXPECT_TRUE(chat.write(" Hello \n", 7));
    EXPECT_TRUE(chat.write("Again", 8));
    const auto sent = chat.due(TimePoint(10s));
    ASSERT_TRUE(sent);
    EXPECT_EQ(*sent, (wire::WriteChat{7, "Hello"}));
    EXPECT_FALSE(chat.due(TimePoint(11s))) << "the host may still answer";
    EXPECT_EQ(chat.due(TimePoint(13s)), sent) << "the answer is lost";
    EXPECT_EQ(chat.take({{message(7, TimePoint(12s), self)}}).size(), 1u);
    EXPECT_EQ(chat.due(TimePoint(13s))->id, 8u);
    EXPECT_EQ(chat.unsent().size(), 1u);
}

TEST(MemberChat, SendsAgainAtOnceOnAnotherConnection) {
    MemberChat chat;
    EXPECT_TRUE(chat.write("Hello", 7));
    EXPECT_TRUE(chat.due(TimePoint(10s)));
    chat.on_connected();
    EXPECT_TRUE(chat.due(TimePoint(10s)));
}

TEST(MemberChat, HasEachMessageOnceAndKnowsItsOwn) {
    MemberChat chat;
    EXPECT_TRUE(chat.write("Hello", 2));
    EXPECT_EQ(chat.take({{message(1, TimePoint(1s)), message(2, TimePoint(2s))}}).size(), 2u);
    // A host that has started anew counts its time anew.
    const auto news = chat.take(
        {{message(1, TimePoint(1s)), message(2, TimePoint(2s)), message(3, TimePoint(0s))}});
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0].id, 3u);
    EXPECT_EQ(chat.messages().back().id, 3u);
    EXPECT_TRUE(chat.is_own(2));
    EXPECT_FALSE(chat.is_own(1));
}

TEST(MemberChat, GoesOnWithWhatAnEarlierProgramHadWritten) {
    MemberChat chat;
    chat.go_on({2, 3}, {{4, "waits"}, {5, "\u200b"}, {6, " waits, too"}});
    EXPECT_EQ(chat.due(TimePoint(10s)), (wire::WriteChat{4, "waits"}));
    // The host had it, which the earlier program did not learn.
    EXPECT_EQ(chat.take({{message(1, TimePoint(1s)), message(2, TimePoint(2s)),
                          message(4, TimePoint(3s))}})
                  .size(),
              3u);
    for (const std::uint64_t own : {2, 3, 4, 6})
        EXPECT_TRUE(chat.is_own(own));
    EXPECT_FALSE(chat.is_own(1));
    EXPECT_EQ(chat.due(TimePoint(10s)), (wire::WriteChat{6, "waits, too"}));

    MemberChat full;
    full.go_on(std::vector<std::uint64_t>(10'000, 1), std::vector(100, wire::WriteChat{7, "text"}));
    EXPECT_EQ(full.unsent().size(), MemberChat::max_unsent);
}

TEST(MemberChat, KeepsTheNewestMessagesAndFewThatAreNotSent) {
    MemberChat chat;
    for (std::uint64_t i = 1; i <= MemberChat::max_kept + 5; ++i)
        (void)chat.take({{message(i, TimePoint(Duration(i)))}});
    EXPECT_EQ(chat.messages().size(), MemberChat::max_kept);
    EXPECT_EQ(chat.messages().front().id, 6u);
    for (std::uint64_t i = 0; i < MemberChat::max_unsent; ++i)
        EXPECT_TRUE(chat.write("text", 1000 + i));
    EXPECT_FALSE(chat.write("one more", 2000));
    for (const char* nothing : {"", "  \r\n ", "\u200b\u200b", "\u3164", "\u00a0"})
        EXPECT_FALSE(MemberChat().write(nothing, 1)) << "nothing to read";
    EXPECT_TRUE(MemberChat().write("\U0001f469\u200d\U0001f3ed", 1));
    EXPECT_EQ(chat.give_up().size(), MemberChat::max_unsent);
    EXPECT_FALSE(chat.due(TimePoint(1s)));
}

TEST(MemberChat, GrowsItsVersionWithEachChange) {
    MemberChat chat;
    std::uint64_t before = chat.version();
    const auto has_grown = [&] { return std::exchange(before, chat.version()) != chat.version(); };
    (void)chat.write("Hello", 7);
    EXPECT_TRUE(has_grown());
    (void)chat.take({{message(7, TimePoint(1s), self)}});
    EXPECT_TRUE(has_grown());
    (void)chat.take({{message(7, TimePoint(1s), self)}});
    EXPECT_FALSE(has_grown());
}

}  // namespace
}  // namespace theatron::session
