// SPDX-License-Identifier: Apache-2.0
#include "client/attempts.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "phrases/phrase.h"
#include "wire/sentence.h"

namespace theatron::client {
namespace {

// The protocol of this program, then that of the host, where they do not go together.
std::optional<std::pair<std::string, std::string>> unlike_protocols(const wire::Text& refusal) {
    const bool is_old = refusal.code == wire::TextCode::program_too_old;
    if ((!is_old && refusal.code != wire::TextCode::host_too_old) || refusal.arguments.size() < 2)
        return std::nullopt;
    const std::string &first = refusal.arguments[0], &second = refusal.arguments[1];
    return is_old ? std::pair(first, second) : std::pair(second, first);
}

}  // namespace

Attempts::Judged Attempts::after(const End& end) {
    if (const auto protocols = unlike_protocols(end.refusal); is_page_ && protocols)
        return {Next::refused,
                say(Phrase::page_of_another_version, protocols->first, protocols->second),
                {},
                true};
    if (!end.refusal.empty()) {
        const bool again = was_in_ && !wire::is_for_good(end.refusal.code);
        return {again ? Next::again : Next::refused, wire::sentence(end.refusal), longest_wait};
    }
    if (end.final)
        return {Next::refused, end.why, {}};
    const bool may_return = end.goodbye.code == wire::TextCode::host_may_return;
    if (!end.goodbye.empty() && !may_return)
        return {Next::ended, wire::sentence(end.goodbye), {}};
    const bool is_farewell = may_return && waited_for_return_ == Duration{};
    if (may_return && return_patience_ && waited_for_return_ >= *return_patience_)
        return {Next::ended, wire::sentence(end.goodbye), {}};
    const Duration wait = std::exchange(wait_, std::min(2 * wait_, longest_wait));
    waited_for_return_ += wait;
    return {Next::again, is_farewell ? wire::sentence(end.goodbye) : end.why, wait};
}

}  // namespace theatron::client
