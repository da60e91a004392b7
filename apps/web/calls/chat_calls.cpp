// SPDX-License-Identifier: Apache-2.0
// The functions that page/chat.js calls: what people write, and hands that they raise.
#include <emscripten/emscripten.h>

#include <cstdlib>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "visit.h"

using namespace theatron;
using theatron::web::page;

namespace {

// The array of this name, or an empty one.
nlohmann::json list_of(const nlohmann::json& json, const char* name) {
    const bool has_it = json.is_object() && json.contains(name) && json[name].is_array();
    return has_it ? json[name] : nlohmann::json::array();
}

// 0: no message has this id.
std::uint64_t id_of(const nlohmann::json& json) {
    return json.is_string() ? std::strtoull(json.get<std::string>().c_str(), nullptr, 10) : 0;
}

}  // namespace

extern "C" {

// {"messages":[{"id":,"name":,"text":,"is_own":,"age_s":}],"unsent":[{"id":,"text":}]}. An age is
// null while the session's time is not known.
EMSCRIPTEN_KEEPALIVE const char* theatron_chat() {
    nlohmann::json messages = nlohmann::json::array(), unsent = nlohmann::json::array();
    if (const client::Participant* participant = page().participant()) {
        const session::MemberChat chat = participant->chat_so_far();
        const bool knows_time = participant->status().clock_known;
        for (const wire::ChatMessage& message : chat.messages())
            // JavaScript's numbers have fewer digits.
            messages.push_back(
                {{"id", std::to_string(message.id)},
                 {"name", message.name},
                 {"text", message.text},
                 {"is_own", chat.is_own(message.id)},
                 {"age_s", knows_time ? nlohmann::json(to_seconds(participant->now() - message.at))
                                      : nlohmann::json()}});
        for (const wire::WriteChat& written : chat.unsent())
            unsent.push_back({{"id", std::to_string(written.id)}, {"text", written.text}});
    }
    page().text = nlohmann::json{{"messages", messages}, {"unsent", unsent}}.dump();
    return page().text.c_str();
}

// For the next join, what the page knew before it was loaded again, as theatron_chat() tells it:
// {"own":[id],"unsent":[{"id":,"text":}],"hand_raised":}. The memory of a tab may hold anything:
// what is not so counts as not there.
EMSCRIPTEN_KEEPALIVE void theatron_go_on(const char* kept) {
    const nlohmann::json json = nlohmann::json::parse(kept, nullptr, false);
    std::vector<std::uint64_t> own;
    for (const nlohmann::json& id : list_of(json, "own"))
        own.push_back(id_of(id));
    std::vector<wire::WriteChat> unsent;
    for (const nlohmann::json& written : list_of(json, "unsent"))
        if (written.is_object() && written.contains("id") && written.contains("text") &&
            written["text"].is_string())
            unsent.push_back({id_of(written["id"]), written["text"]});
    page().chat.go_on(own, unsent);
    page().hand_raised = json.is_object() && json.contains("hand_raised") &&
                         json["hand_raised"] == nlohmann::json(true);
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
