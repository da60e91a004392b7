// SPDX-License-Identifier: Apache-2.0
// The panel of messages: what people write to all others, and where the person writes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "viewer/room_panel.h"
#include "viewer/text_draft.h"

namespace theatron::viewer {

struct ChatPanelFacts {
    client::Participant::Chat chat;
    TimePoint now;  // session time
    bool may_write = false;
    bool has_keyboard = true;  // false: quick answers alone
};

class ChatPanel {
public:
    // Messages in the panel, the newest first.
    static constexpr std::size_t most_shown = 60;

    // Until end() what the person types belongs to the message.
    void begin() { is_writing_ = true; }
    void end() { is_writing_ = false; }
    bool is_writing() const { return is_writing_; }
    // Returns the message that the person has finished; empty: none.
    std::string type(const window::FormKeyPress& press);
    // It could not be sent: it is there again, unless the person writes another one.
    void put_back(const std::string& message);

    // The person has seen all of these messages.
    void note_seen(const client::Participant::Chat& chat);
    // Messages of others that the person has not seen.
    std::size_t unseen(const client::Participant::Chat& chat) const;

    void add_panel(const ChatPanelFacts& facts, RoomPanel& panel) const;

private:
    TextDraft draft_{wire::max_chat_text};
    bool is_writing_ = false;
    std::optional<std::uint64_t> seen_;  // the newest message that the person has seen
};

}  // namespace theatron::viewer
