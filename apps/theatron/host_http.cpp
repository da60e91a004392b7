// SPDX-License-Identifier: Apache-2.0
#include "host_http.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/outside_text.h"
#include "net/certificate.h"
#include "net/https_get.h"

namespace theatron::app {
namespace {

// "%2B" and "+" as a browser writes them.
std::string decoded(std::string_view text) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'                 ? c - '0'
               : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10
                                                    : -1;
    };
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 &&
            digit(text[i + 2]) >= 0) {
            result += char(digit(text[i + 1]) * 16 + digit(text[i + 2]));
            i += 2;
        } else {
            result += text[i] == '+' ? ' ' : text[i];
        }
    }
    return result;
}

std::string shown_token(const net::HttpRequest& request, std::string_view query) {
    constexpr std::string_view bearer = "Bearer ", parameter = "token=";
    if (request.authorization.starts_with(bearer))
        return request.authorization.substr(bearer.size());
    while (!query.empty()) {
        const std::string_view part = query.substr(0, query.find('&'));
        if (part.starts_with(parameter))
            return decoded(part.substr(parameter.size()));
        query.remove_prefix(std::min(query.size(), part.size() + 1));
    }
    return {};
}

}  // namespace

std::optional<net::HttpAnswer> answer_http(const net::HttpRequest& request,
                                           const std::vector<std::string>& tokens,
                                           const std::function<HostFigures()>& figures) {
    const std::string_view target = request.target;
    const std::string_view path = target.substr(0, target.find('?'));
    if (path != "/status" && path != "/metrics")
        return std::nullopt;
    const std::string shown =
        shown_token(request, target.substr(std::min(target.size(), path.size() + 1)));
    bool known = false;
    for (const std::string& token : tokens)
        known = net::equal_secrets(shown, token) || known;
    if (!known)
        return net::HttpAnswer{.status = 401, .body = "Show the token: docs/metrics.md\n"};
    if (path == "/status")
        return net::HttpAnswer{.type = "application/json",
                               .body = to_json(figures()).dump() + "\n"};
    return net::HttpAnswer{.type = "text/plain; version=0.0.4; charset=utf-8",
                           .body = to_prometheus(figures())};
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
    const net::HttpsAnswer answer = net::https_get(link, "/status");
    if (answer.status == 401)
        throw Error("The host does not know the link's token; ask for its current link.");
    bool too_deep = false;
    const auto figures = nlohmann::json::parse(
        answer.body,
        [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
            too_deep = too_deep || depth > max_status_depth;
            return !too_deep;
        },
        false);
    if (answer.status != 200 || too_deep || !figures.is_object())
        throw Error("The host does not tell its status; it may be of an older version.");
    return cleaned(figures);
}

}  // namespace theatron::app
