// SPDX-License-Identifier: Apache-2.0
// What a host tells over HTTP to those who show a token, /status and /metrics, and how to ask for
// it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/host_figures.h"
#include "net/http.h"
#include "net/link.h"

namespace theatron::host {

// `tokens`: any of these will do, in the header
// "Authorization: Bearer TOKEN" or in the query as token=TOKEN.
net::HttpAnswer answer_http(const net::HttpRequest& request, const std::vector<std::string>& tokens,
                            const std::function<HostFigures()>& figures);

// What a host, perhaps on another machine, answers to /status: see to_json(). Its texts are clean
// (base/outside_text.h). Throws Error, also at an answer that is nested more deeply than any
// host's.
inline constexpr int max_status_depth = 16;
inline constexpr std::size_t max_status_text = 1000;  // characters of one text in it
nlohmann::json status_of_host(const net::Link& link);

}  // namespace theatron::host
