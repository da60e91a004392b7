// SPDX-License-Identifier: Apache-2.0
// The pages of a host's port: what a browser, a monitoring system or a form before a session gets,
// by the token that it shows.
#pragma once

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

}  // namespace theatron::host
