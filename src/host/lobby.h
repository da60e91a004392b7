// SPDX-License-Identifier: Apache-2.0
// The lobby of a host: what a link lets its bearer see of sessions before joining one.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/closed_session.h"
#include "host/host_figures.h"
#include "host/session_switch.h"
#include "net/http.h"
#include "net/https_get.h"
#include "net/link.h"
#include "wire/role.h"

namespace theatron::host {

// True for the pages /lobby and /thumbnail.
bool is_lobby(const net::HttpRequest& request);

// The bearer of a link.
struct LobbyGuest {
    wire::Role role{};
    bool must_ask = false;      // waits for admission
    bool is_held_back = false;  // somebody who came by this link was removed, and is kept out
    bool sees_inside() const { return !must_ask && !is_held_back; }
};

// {"role","sessions":[{"name","asks","held_back","ended","people_count",
// "people":[{"name","role","muted"}],"cameras":[{"name","state"}],"thumbnail"}]}. For a guest who
// does not see inside: without names, cameras and picture; "held_back" is missing for others.
nlohmann::json lobby_json(const HostFigures& figures, const LobbyGuest& guest);
// A further element of its "sessions", whose picture has this address.
nlohmann::json lobby_session(const HostFigures& figures, const LobbyGuest& guest,
                             const std::string& thumbnail);
// The same of a session that is not open: {"name","closed","problem"}.
nlohmann::json lobby_session(const ClosedSession& session);

// The answer to a request for which is_lobby() holds. The bearer of a link sees the session of the
// link; an operator of the first session sees all of them, also those that are not open.
net::HttpAnswer answer_lobby(const net::HttpRequest& request,
                             const SessionSwitch::Sessions& sessions,
                             const std::vector<ClosedSession>& closed);

// The same from a host, perhaps on another machine; its texts are clean. Throws Error, also if the
// host does not answer within `patience`.
nlohmann::json lobby_of_host(const net::Link& link, Duration patience = net::https_patience);
// The picture of the link's session as PNG, or of another one in whose lobby it has this
// `address`; nullopt if the host gives none. Throws Error.
std::optional<std::string> thumbnail_of_host(const net::Link& link,
                                             Duration patience = net::https_patience,
                                             const std::string& address = "/thumbnail");

}  // namespace theatron::host
