// SPDX-License-Identifier: Apache-2.0
// The host's HTTP pages /status and /metrics, which need a token, and a client
// for /status.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/host_figures.h"
#include "net/http.h"
#include "net/https_get.h"
#include "net/link.h"

namespace theatron::host {

enum class MayRead {
    yes,         // the request shows a token that opens the figures
    no,          // it does not
    must_knock,  // its token is known, but people who come by it see nothing before they are let in
};
// `figures`: those of all sessions that the token opens, at least one.
net::HttpAnswer answer_http(const net::HttpRequest& request, MayRead may_read,
                            const std::function<PortFigures()>& figures);

// Asks a host, perhaps on another machine, for /status: see to_json(). Its texts are clean
// (base/outside_text.h). Throws Error, also for an answer that is nested more deeply than a host's
// ever is.
inline constexpr int max_status_depth = 16;
inline constexpr std::size_t max_status_text = 1000;  // characters of one text in it
nlohmann::json status_of_host(const net::Link& link);
// Throws Error if a host's answer says that it does not know the token, that it has expired, or
// that it shows nothing now.
void require_known_token(const net::HttpsAnswer& answer);
// The same for another page with JSON. `what` of Error's sentence: "status".
nlohmann::json json_of_host(const net::Link& link, const std::string& target, const char* what,
                            Duration patience = net::https_patience);

}  // namespace theatron::host
