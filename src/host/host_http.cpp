// SPDX-License-Identifier: Apache-2.0
#include "host/host_http.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/outside_text.h"
#include "files/json_text.h"
#include "net/https_get.h"

namespace theatron::host {
namespace {

constexpr const char* plain_answer =
    "This is a Theatron host. Join it with: theatron join LINK\n"
    "A browser cannot join yet, because the browser client is not built: as soon as 'make build' "
    "has\n"
    "made it, this host serves it here.\n";

constexpr const char* must_knock =
    "This link's people are let in one by one, so it shows nothing of the session; use an "
    "operator's link, or the host's metrics.token.\n";

}  // namespace

net::HttpAnswer answer_http(const net::HttpRequest& request, MayRead may_read,
                            const std::function<PortFigures()>& figures) {
    const std::string_view path = net::path_of(request.target);
    if (path == "/")
        return {.body = plain_answer};
    if (path != "/status" && path != "/metrics")
        return {.status = 404, .body = "There is nothing here.\n"};
    if (may_read == MayRead::must_knock)
        return {.status = 401, .body = must_knock};
    if (may_read == MayRead::no)
        return {.status = 401, .body = "Show the token: docs/metrics.md\n"};
    if (path == "/status")
        return {.type = "application/json", .body = files::json_text(to_json(figures())) + "\n"};
    return {.type = "text/plain; version=0.0.4; charset=utf-8", .body = to_prometheus(figures())};
}

namespace {

// The same with every text fit to be shown. `figures` is not nested deeply.
nlohmann::json cleaned(const nlohmann::json& figures) {
    if (figures.is_string())
        return clean_text(figures.get_ref<const std::string&>(), max_status_text);
    if (!figures.is_structured())
        return figures;
    nlohmann::json result =
        figures.is_object() ? nlohmann::json::object() : nlohmann::json::array();
    for (const auto& [key, value] : figures.items()) {
        if (figures.is_object())
            result[clean_text(key, max_status_text)] = cleaned(value);
        else
            result.push_back(cleaned(value));
    }
    return result;
}

}  // namespace

nlohmann::json status_of_host(const net::Link& link) {
    return json_of_host(link, "/status", "status");
}

void require_known_token(const net::HttpsAnswer& answer) {
    if (answer.status == 503)
        throw Error("This session is not open at the moment; try again soon.");
    if (answer.status == 410)
        throw Error("This link has expired; ask for a new one.");
    if (answer.status == 403)
        throw Error(
            "Somebody who came by this link was removed from the session, so it shows nothing of "
            "it until the session ends; ask for another link.");
    if (answer.status == 401 && answer.body == must_knock)
        throw Error(answer.body.substr(0, answer.body.find('\n')));
    if (answer.status == 401)
        throw Error("The host does not know the link's token; ask for its current link.");
}

nlohmann::json json_of_host(const net::Link& link, const std::string& target, const char* what,
                            Duration patience) {
    const net::HttpsAnswer answer = net::https_get(link, target, patience);
    require_known_token(answer);
    bool too_deep = false;
    const auto figures = nlohmann::json::parse(
        answer.body,
        [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
            too_deep = too_deep || depth > max_status_depth;
            return !too_deep;
        },
        false);
    if (answer.status != 200 || too_deep || !figures.is_object())
        throw Error(std::string("The host does not tell its ") + what +
                    "; it may be of an older version.");
    return cleaned(figures);
}

}  // namespace theatron::host
