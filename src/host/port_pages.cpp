// SPDX-License-Identifier: Apache-2.0
#include "host/port_pages.h"

#include <string>
#include <utility>
#include <vector>

#include "base/steady_clock.h"
#include "host/host_http.h"
#include "host/lobby.h"
#include "net/certificate.h"

namespace theatron::host {
namespace {

bool has_expired(const std::string& secret, const SessionSwitch::Sessions& sessions) {
    for (const auto& [number, session] : sessions)
        if (const auto token = session.find_token(secret))
            return token->expires && steady_now() >= *token->expires;
    return false;
}

// The sessions whose figures this token opens. That of the host's monitoring, and an operator of
// its first session, read all.
std::vector<const PortSession*> opened_by(const std::string& secret,
                                          const SessionSwitch::Sessions& sessions) {
    std::vector<const PortSession*> opened;
    for (const auto& [number, session] : sessions) {
        bool known = false;
        for (const std::string& token : session.http_tokens())
            known = net::equal_secrets(secret, token) || known;
        if (known)
            opened.push_back(&session);
    }
    if (opened.empty() || opened.front() != &sessions.front().second)
        return opened;
    const PortSession& first = *opened.front();
    const auto token = first.find_token(secret);
    if (net::equal_secrets(secret, first.metrics_token) ||
        (token && token->role == wire::Role::operator_)) {
        opened.clear();
        for (const auto& [number, session] : sessions)
            opened.push_back(&session);
    }
    return opened;
}

}  // namespace

net::HttpAnswer answer_page(const net::HttpRequest& request, const Page& page,
                            const SessionSwitch::Sessions& sessions) {
    const std::string secret = net::shown_token(request);
    if (has_expired(secret, sessions))
        return {.status = 410, .body = "This link has expired; ask for a new one.\n"};
    if (is_lobby(request))
        return answer_lobby(request, sessions);
    if (auto file = page.answer(request))
        return std::move(*file);
    const std::vector<const PortSession*> opened = opened_by(secret, sessions);
    return answer_http(request, !opened.empty(), [&] {
        std::vector<HostFigures> figures;
        for (const PortSession* session : opened)
            figures.push_back(session->figures());
        return figures;
    });
}

}  // namespace theatron::host
