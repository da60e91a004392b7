// SPDX-License-Identifier: Apache-2.0
// The functions that page/chat.js calls: what people write, and hands that they raise.
#include <emscripten/emscripten.h>

#include <nlohmann/json.hpp>

#include "visit.h"

using namespace theatron;
using theatron::web::page;

extern "C" {

// {"messages":[{"id":,"name":,"text":,"is_own":,"age_s":}],"unsent":[]}. An age is null while the
// session's time is not known.
EMSCRIPTEN_KEEPALIVE const char* theatron_chat() {
    nlohmann::json messages = nlohmann::json::array(), unsent = nlohmann::json::array();
    if (const client::Participant* participant = page().participant()) {
        const client::Participant::Chat chat = participant->chat();
        const bool knows_time = participant->status().clock_known;
        for (const wire::ChatMessage& message : chat.messages)
            // JavaScript's numbers have fewer digits.
            messages.push_back(
                {{"id", std::to_string(message.id)},
                 {"name", message.name},
                 {"text", message.text},
                 {"is_own", chat.own.contains(message.id)},
                 {"age_s", knows_time ? nlohmann::json(to_seconds(participant->now() - message.at))
                                      : nlohmann::json()}});
        unsent = chat.unsent;
    }
    page().text = nlohmann::json{{"messages", messages}, {"unsent", unsent}}.dump();
    return page().text.c_str();
}

// Writes to all others; 0: the person may not, or too many messages wait for the host.
EMSCRIPTEN_KEEPALIVE int theatron_write_chat(const char* text) {
    return page().participant() && page().participant()->write_chat(text);
}

// Raises the person's hand (1), or takes it down (0).
EMSCRIPTEN_KEEPALIVE void theatron_raise_hand(int raised) {
    if (page().participant())
        page().participant()->raise_hand(raised != 0);
}

}  // extern "C"
