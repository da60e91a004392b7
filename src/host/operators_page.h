// SPDX-License-Identifier: Apache-2.0
// The page of a host's operators (docs/operators_page.md) reads and does all of this by the token
// of an operator's link: cameras, people, links, sessions and a recording. The operator of the
// first session may do so in all of them, another one in its own.
//
// On the door's thread. Every change is carried out by the session, which writes it into the audit
// log; nothing that is answered may be kept by a cache.
#pragma once

#include <filesystem>
#include <vector>

#include "host/closed_session.h"
#include "host/session_switch.h"
#include "net/http.h"
#include "net/link.h"

namespace theatron::host {

// True for all addresses below. The page itself, /operators, is a file (page.h).
bool is_of_operators(const net::HttpRequest& request);

// GET /operators/facts:
// {"own","sessions":[{"number","name","is_own","may_end","ended","cameras":[{"name",
// "state","problem","fps","age_ms","has_picture"}],"people":[{"id","name","role","muted"}],"visitors":[{"id",
// "name","role","records"}],"links":[{"name","role","until","expired","for","is_own"}],
// "recording":{"phase","file","seconds","bytes","free_bytes","problem"},"problems":[…]}],"closed":[{"name","problem"}],
// "may_create"}.
// GET /operators/picture?session=N&camera=I: PNG, or 204 before there is one.
// 401, 403 or 410 for a token that is not an operator's.
net::HttpAnswer answer_operator(const net::HttpRequest& request,
                                const SessionSwitch::Sessions& sessions,
                                const std::vector<ClosedSession>& closed);

// POST without a body; `session=N` names another session than that of the token.
//   /operators/link?role=R&hours=H&for=TEXT   makes a link: that of GET with "link" and "qr", rows
//   /operators/link?show=NAME                 shows one      of '0' and '1' (qr_code.h)
//   /operators/link?revoke=NAME               makes one invalid
//   /operators/person?id=N&do=admit           or turn_away, mute, unmute, remove
//   /operators/recording?do=start             or stop
//   /operators/session?create=NAME            a further session, without cameras of its own
//   /operators/session?end=NAME               ends a further one for good
// 200 or 204; 400, 404 or 409 with one sentence where it cannot be done; 401, 403, 410 as above.
struct OperatorsHost {
    net::Link address;  // for people, without a token
    net::Link own;      // for a program on this machine
    std::filesystem::path state_folder;
};
net::HttpAnswer act_for_operator(const net::HttpRequest& request,
                                 const SessionSwitch::Sessions& sessions,
                                 const OperatorsHost& host);

}  // namespace theatron::host
