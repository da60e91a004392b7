// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels/chat_panel.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using window::FormKey;
constexpr ParticipantId writer{2};

client::Participant::Chat chat_of(int count) {
    client::Participant::Chat chat;
    for (int i = 0; i < count; ++i) {
        chat.messages.push_back({std::uint64_t(i + 1), writer, "Anna", "text " + std::to_string(i),
                                 TimePoint(std::chrono::minutes(i))});
        if (i % 2)
            chat.own.insert(std::uint64_t(i + 1));
    }
    return chat;
}

window::Panel panel_of(const ChatPanel& chat, const ChatPanelFacts& facts) {
    RoomPanel panel;
    chat.add_panel(facts, panel);
    return panel.panels.at(0);
}

TEST(ChatPanel, HasTheNewestMessagesFirstWithTheirAuthorsAndAges) {
    ChatPanelFacts facts;
    facts.chat = chat_of(70);
    facts.now = TimePoint(std::chrono::minutes(72));
    const auto rows = panel_of({}, facts).rows;
    ASSERT_EQ(rows.size(), 1 + ChatPanel::most_shown);
    EXPECT_EQ(rows[0].text, say(Phrase::may_not_write));
    EXPECT_EQ(rows[1].text, "text 69");
    EXPECT_EQ(rows[1].detail, "You, 3 min ago");
    EXPECT_EQ(rows[2].detail, "Anna, 4 min ago");
}

TEST(ChatPanel, WhatIsTypedBecomesAMessage) {
    ChatPanel chat;
    chat.begin();
    EXPECT_EQ(chat.type({FormKey::letters, false, false, "Hello"}), "");
    ChatPanelFacts facts;
    facts.may_write = true;
    EXPECT_EQ(panel_of(chat, facts).rows.at(0).text, "Hello_");
    EXPECT_EQ(chat.type({FormKey::enter}), "Hello");
    EXPECT_TRUE(chat.is_writing()) << "the next message may follow";
    EXPECT_EQ(chat.type({FormKey::enter}), "");
    (void)chat.type({FormKey::letters, false, false, "Once more"});
    facts.may_write = false;
    EXPECT_EQ(panel_of(chat, facts).rows.at(0).text, "Once more_")
        << "the person is muted meanwhile";
    EXPECT_EQ(chat.type({FormKey::enter}), "Once more");
    chat.put_back("Once more");
    EXPECT_EQ(panel_of(chat, facts).rows.at(0).text, "Once more_");
    (void)chat.type({FormKey::escape});
    EXPECT_FALSE(chat.is_writing());
    EXPECT_EQ(chat.type({FormKey::enter}), "") << "nobody writes any more";
}

TEST(ChatPanel, CountsTheMessagesOfOthersThatWereNotSeen) {
    ChatPanel chat;
    EXPECT_EQ(chat.unseen(chat_of(3)), 2u);
    chat.note_seen(chat_of(3));
    EXPECT_EQ(chat.unseen(chat_of(3)), 0u);
    EXPECT_EQ(chat.unseen(chat_of(7)), 2u);
}

TEST(ChatPanel, WithoutAKeyboardThereAreQuickAnswersAlone) {
    ChatPanelFacts facts;
    facts.may_write = true;
    facts.has_keyboard = false;
    RoomPanel panel;
    ChatPanel().add_panel(facts, panel);
    const auto& yes = panel.panels.at(0).rows.at(0).buttons.at(0);
    EXPECT_EQ(yes.label, "Yes");
    EXPECT_EQ(std::get<SendText>(panel.commands.at(std::size_t(yes.command))).text, "Yes");
    for (const RoomCommand& command : panel.commands)
        EXPECT_FALSE(std::holds_alternative<WriteText>(command));
}

}  // namespace
}  // namespace theatron::viewer
