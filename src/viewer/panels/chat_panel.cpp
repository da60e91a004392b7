// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels/chat_panel.h"

#include <algorithm>
#include <utility>

#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

std::string when_text(Duration ago) {
    const auto minutes = ago / std::chrono::minutes(1);
    return minutes < 1 ? say(Phrase::just_now) : say(Phrase::minutes_ago, std::to_string(minutes));
}

}  // namespace

std::string ChatPanel::type(const window::FormKeyPress& press) {
    if (!is_writing_)
        return "";
    switch (draft_.take(press)) {
        case TextDraft::Result::goes_on:
            return "";
        case TextDraft::Result::given_up:
            end();
            return "";
        case TextDraft::Result::finished:
            break;
    }
    std::string text = draft_.text();
    draft_.set("");
    return text;
}

void ChatPanel::put_back(const std::string& message) {
    if (draft_.text().empty())
        draft_.set(message);
}

void ChatPanel::note_seen(const client::Participant::Chat& chat) {
    if (!chat.messages.empty())
        seen_ = chat.messages.back().id;
}

std::size_t ChatPanel::unseen(const client::Participant::Chat& chat) const {
    const auto newest_seen =
        std::find_if(chat.messages.rbegin(), chat.messages.rend(),
                     [&](const wire::ChatMessage& message) { return message.id == seen_; });
    return std::size_t(std::count_if(
        chat.messages.rbegin(), newest_seen,
        [&](const wire::ChatMessage& message) { return !chat.own.contains(message.id); }));
}

void ChatPanel::add_panel(const ChatPanelFacts& facts, RoomPanel& panel) const {
    window::Panel chat{say(Phrase::messages), {}};
    const auto button = [&](Phrase label, RoomCommand command) {
        return panel.button(say(label), std::move(command));
    };
    const auto quick = [&](Phrase answer) { return button(answer, SendText{say(answer)}); };
    // A person who is muted meanwhile still sees the letters that they type.
    if (is_writing_)
        chat.rows.push_back({draft_.text() + "_",
                             say(facts.may_write ? Phrase::enter_sends : Phrase::may_not_write),
                             {}});
    else if (facts.may_write && facts.has_keyboard)
        chat.rows.push_back({"", "", {button(Phrase::write, WriteText{})}});
    if (facts.may_write) {
        chat.rows.push_back(
            {"",
             "",
             {quick(Phrase::quick_yes), quick(Phrase::quick_no), quick(Phrase::quick_wait)}});
        chat.rows.push_back(
            {"", "", {quick(Phrase::quick_not_heard), quick(Phrase::quick_not_seen)}});
    } else if (!is_writing_) {
        chat.rows.push_back({say(Phrase::may_not_write), "", {}});
    }
    for (auto text = facts.chat.unsent.rbegin(); text != facts.chat.unsent.rend(); ++text)
        chat.rows.push_back({*text, say(Phrase::is_being_sent), {}});
    std::size_t shown = 0;
    for (auto message = facts.chat.messages.rbegin();
         message != facts.chat.messages.rend() && shown < most_shown; ++message, ++shown) {
        const bool is_own = facts.chat.own.contains(message->id);
        chat.rows.push_back(
            {message->text,
             say(Phrase::person_when, is_own ? say(Phrase::you_yourself) : message->name,
                 when_text(facts.now - message->at)),
             {}});
    }
    if (facts.chat.messages.empty() && facts.chat.unsent.empty())
        chat.rows.push_back({say(Phrase::no_messages), "", {}});
    panel.panels.push_back(std::move(chat));
}

}  // namespace theatron::viewer
