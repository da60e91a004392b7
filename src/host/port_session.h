// SPDX-License-Identifier: Apache-2.0
// A session as the port of its host sees it: functions for its own connections, and the facts that
// the port may tell others.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/host_figures.h"
#include "host/link_book.h"
#include "host/recording_program.h"
#include "net/server.h"
#include "session/admission.h"
#include "session/audit_event.h"
#include "wire/control.h"
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
    // PNG, of a camera of the host; empty: none.
    std::function<std::string(std::size_t camera)> picture;

    // For operators (operators_page.h). `by`: as in session::AuditEvent.
    std::function<std::vector<KnownLink>()> links;
    // Throws Error.
    std::function<KnownLink(wire::Role, std::optional<files::UtcSeconds> expires,
                            const std::string& label, const std::string& by)>
        make_link;
    std::function<void(const std::string& link, const std::string& by)> revoke_link;
    std::function<void(wire::ManageAction, ParticipantId, const std::string& by)> manage;
    std::function<RecordingProgram&()> recording;
    std::function<void(const session::AuditEvent&)> audit;
};

}  // namespace theatron::host
