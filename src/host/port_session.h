// SPDX-License-Identifier: Apache-2.0
// A session as the port of its host sees it: functions for its own connections, and the facts that
// the port may tell others.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/host_figures.h"
#include "net/server.h"
#include "session/admission.h"
#include "wire/role.h"

namespace theatron::host {

struct PortSession {
    std::string name_in_log;  // empty for the first session of a host
    // For the connections of this session, on the server's thread; `tick` and `alarm` as well.
    // `invited`, `http`, `turned_away` and `now` are the port's own and stay empty.
    net::Server::Handler events;

    // On the server's thread: see Admission. Empty: it knows nobody again.
    std::function<bool(const wire::Join&)> knows_again;

    // All below on any thread.
    // The link whose token this is; it may have expired. Compares in constant time.
    std::function<std::optional<session::Admission::Token>(const std::string& secret)> find_token;
    // True if a participant with this role waits for admission.
    std::function<bool(wire::Role)> must_ask;
    // True if somebody who came by the link of this token was removed, and is kept out.
    std::function<bool(const std::string& secret)> is_held_back;
    // Those that open the figures.
    std::function<std::vector<std::string>()> http_tokens;
    std::string metrics_token;  // one of them
    std::function<HostFigures()> figures;
    std::function<std::string()> picture;  // PNG, of the first camera; empty: none
};

}  // namespace theatron::host
