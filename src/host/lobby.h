// SPDX-License-Identifier: Apache-2.0
// The lobby of a host: what a link lets its bearer see of sessions before joining one.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/host_figures.h"
#include "host/session_switch.h"
#include "net/http.h"
#include "net/https_get.h"
#include "net/link.h"
#include "wire/role.h"

namespace theatron::host {

// True for the pages /lobby and /thumbnail.
bool is_lobby(const net::HttpRequest& request);

// {"role","sessions":[{"name","asks","ended","people_count","people":[{"name","role","muted"}],
// "cameras":[{"name","state"}],"thumbnail"}]}. For a link by which one has to wait for admission:
// without names, cameras and picture.
nlohmann::json lobby_json(const HostFigures& figures, wire::Role role, bool must_ask);
// A further element of its "sessions", whose picture has this address.
nlohmann::json lobby_session(const HostFigures& figures, bool must_ask,
                             const std::string& thumbnail);

// The answer to a request for which is_lobby() holds. The bearer of a link sees the session of the
// link; an operator of the first session sees all of them.
net::HttpAnswer answer_lobby(const net::HttpRequest& request,
                             const SessionSwitch::Sessions& sessions);

// The same from a host, perhaps on another machine; its texts are clean. Throws Error, also if the
// host does not answer for so long.
nlohmann::json lobby_of_host(const net::Link& link, Duration patience = net::https_patience);
// Its picture as PNG; nullopt if the host gives none. Throws Error.
std::optional<std::string> thumbnail_of_host(const net::Link& link,
                                             Duration patience = net::https_patience);

}  // namespace theatron::host
