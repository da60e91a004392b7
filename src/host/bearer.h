// SPDX-License-Identifier: Apache-2.0
// The link by which an HTTP request asks, and the session to which it leads.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/steady_clock.h"
#include "files/utc_text.h"
#include "host/session_switch.h"

namespace theatron::host {

struct Bearer {
    const SessionSwitch::Sessions::value_type* session =
        nullptr;                      // of the sessions that were asked
    session::Admission::Token token;  // it may have expired
    bool has_expired() const { return token.has_expired(steady_now(), files::utc_now()); }
};

// Nullopt: this is the token of no link.
inline std::optional<Bearer> find_bearer(const std::string& secret,
                                         const SessionSwitch::Sessions& sessions) {
    for (const auto& entry : sessions)
        if (auto token = entry.second.find_token(secret))
            return Bearer{&entry, std::move(*token)};
    return std::nullopt;
}

}  // namespace theatron::host
