// SPDX-License-Identifier: Apache-2.0
#include "chat_lines.h"

#include "base/log.h"
#include "base/trimmed.h"

namespace theatron::app {
namespace {

std::string why_not_written(const client::Participant& participant, std::string_view text) {
    if (text.empty())
        return "Say 'chat TEXT'.";
    if (participant.status().phase != client::Participant::Phase::joined)
        return "You have not joined yet; the message is not sent.";
    if (participant.status().standing.muted)
        return "You are muted; the message is not sent.";
    if (!participant.has_chat())
        return "This host is of an earlier version and takes no messages.";
    return "Too many messages wait to be sent; this one is not.";
}

}  // namespace

const char* chat_lines_help() {
    return "'chat TEXT' (to all), 'hand up', 'hand down'";
}

bool obey_chat_line(client::Participant& participant, const std::string& line) {
    const std::string_view words = trimmed(line);
    if (words == "hand up" || words == "hand down") {
        if (!participant.raise_hand(words == "hand up"))
            log::say("You have not joined, or this host knows no raised hands.");
        return true;
    }
    constexpr std::string_view begin = "chat";
    if (words != begin && !words.starts_with("chat "))
        return false;
    const std::string text(trimmed(words.substr(begin.size())));
    if (!participant.write_chat(text))
        log::say(why_not_written(participant, text));
    return true;
}

nlohmann::json chat_json(const client::Participant& participant) {
    const client::Participant::Chat chat = participant.chat();
    nlohmann::json messages = nlohmann::json::array();
    for (const wire::ChatMessage& message : chat.messages)
        messages.push_back({{"from", std::uint32_t(message.participant)},
                            {"name", message.name},
                            {"text", message.text},
                            {"session_us", to_us(message.at)}});
    return {
        {"may_write", participant.may_write()}, {"messages", messages}, {"unsent", chat.unsent}};
}

}  // namespace theatron::app
