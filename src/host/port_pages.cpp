// SPDX-License-Identifier: Apache-2.0
#include "host/port_pages.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "host/bearer.h"
#include "host/host_http.h"
#include "host/lobby.h"
#include "host/operators_page.h"
#include "net/certificate.h"

namespace theatron::host {
namespace {

bool has_expired(const std::string& secret, const SessionSwitch::Sessions& sessions) {
    const auto bearer = find_bearer(secret, sessions);
    return bearer && bearer->has_expired();
}

bool is_held_back(const std::string& secret, const SessionSwitch::Sessions& sessions) {
    return std::ranges::any_of(
        sessions, [&](const auto& entry) { return entry.second.is_held_back(secret); });
}

bool must_knock(const std::string& secret, const SessionSwitch::Sessions& sessions) {
    const auto bearer = find_bearer(secret, sessions);
    return bearer && bearer->session->second.must_ask(bearer->token.role);
}

// True for an operator's token, and that of the host's monitoring.
bool decides_on_people(const std::string& secret, const SessionSwitch::Sessions& sessions) {
    const auto bearer = find_bearer(secret, sessions);
    return (bearer && bearer->token.role == wire::Role::operator_) ||
           std::ranges::any_of(sessions, [&](const auto& entry) {
               return net::equal_secrets(secret, entry.second.metrics_token);
           });
}

// The sessions whose figures a token opens.
struct Opened {
    std::vector<const PortSession*> sessions;
    bool is_all = false;  // also those that are not open
};

// The token of the host's monitoring, and an operator of its first session, read all.
Opened opened_by(const std::string& secret, const SessionSwitch::Sessions& sessions) {
    std::vector<const PortSession*> opened;
    for (const auto& [number, session] : sessions) {
        bool known = false;
        for (const std::string& token : session.http_tokens())
            known = net::equal_secrets(secret, token) || known;
        if (known)
            opened.push_back(&session);
    }
    if (opened.empty() || opened.front() != &sessions.front().second)
        return {opened};
    const PortSession& first = *opened.front();
    const auto token = first.find_token(secret);
    if (!net::equal_secrets(secret, first.metrics_token) &&
        !(token && token->role == wire::Role::operator_))
        return {opened};
    opened.clear();
    for (const auto& [number, session] : sessions)
        opened.push_back(&session);
    return {opened, true};
}

net::HttpAnswer expired() {
    return {.status = 410, .body = "This link has expired; ask for a new one.\n"};
}

net::HttpAnswer held_back() {
    return {.status = 403, .body = "Somebody who came by this link was removed: docs/room.md\n"};
}

}  // namespace

net::HttpAnswer answer_page(const net::HttpRequest& request, const Page& page,
                            const SessionSwitch::Sessions& sessions,
                            const std::vector<ClosedSession>& closed) {
    // For load balancers and monitoring, without a token: it tells strangers nothing but that.
    if (net::path_of(request.target) == "/health")
        return sessions.empty() ? net::HttpAnswer{.status = 503, .body = "No session is open.\n"}
                                : net::HttpAnswer{.status = 200, .body = "A session is open.\n"};
    const std::string secret = net::shown_token(request);
    if (has_expired(secret, sessions))
        return expired();
    if (is_lobby(request))
        return answer_lobby(request, sessions, closed);
    if (is_of_operators(request))
        return answer_operator(request, sessions, closed);
    if (auto file = page.answer(request))
        return std::move(*file);
    if (is_held_back(secret, sessions))
        return held_back();
    const Opened opened = opened_by(secret, sessions);
    const MayRead may_read = !opened.sessions.empty()       ? MayRead::yes
                             : must_knock(secret, sessions) ? MayRead::must_knock
                                                            : MayRead::no;
    return answer_http(request, may_read, [&] {
        PortFigures figures;
        for (const PortSession* session : opened.sessions) {
            figures.sessions.push_back(session->figures());
            // Only those who decide on them need to know who waits at the door.
            if (!decides_on_people(secret, sessions))
                for (wire::Visitor& visitor : figures.sessions.back().visitors)
                    visitor = {.role = visitor.role};
        }
        if (opened.is_all)
            figures.closed = closed;
        return figures;
    });
}

std::optional<net::HttpAnswer> refuse_line(const net::HttpRequest& request,
                                           const SessionSwitch::Sessions& sessions) {
    const std::string secret = net::shown_token(request);
    if (has_expired(secret, sessions))
        return expired();
    if (is_held_back(secret, sessions))
        return held_back();
    if (!find_bearer(secret, sessions))
        return net::HttpAnswer{.status = 401, .body = "Show the token of a link: docs/room.md\n"};
    return std::nullopt;
}

}  // namespace theatron::host
