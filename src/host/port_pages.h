// SPDX-License-Identifier: Apache-2.0
// The pages of a host's port: what a browser, a monitoring system or a form before a session gets,
// by the token that it shows.
#pragma once

#include <optional>
#include <vector>

#include "host/closed_session.h"
#include "host/page.h"
#include "host/session_switch.h"
#include "net/http.h"

namespace theatron::host {

// `sessions`: of the port, the first one first; there may be none. `closed`: those that are not
// open. On the door's thread.
net::HttpAnswer answer_page(const net::HttpRequest& request, const Page& page,
                            const SessionSwitch::Sessions& sessions,
                            const std::vector<ClosedSession>& closed);

// Why the bearer of a token may not measure the line to the host (line_probe.h); nullopt for one
// with a link of an open session, also while they wait to be let in.
std::optional<net::HttpAnswer> refuse_line(const net::HttpRequest& request,
                                           const SessionSwitch::Sessions& sessions);

}  // namespace theatron::host
