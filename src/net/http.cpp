// SPDX-License-Identifier: Apache-2.0
#include "net/http.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/small_letters.h"

namespace theatron::net {
namespace {

// -1: no hex digit.
int digit(char c) {
    return c >= '0' && c <= '9'                 ? c - '0'
           : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10
                                                : -1;
}

std::string decoded(std::string_view text) {
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

bool has_only(std::string_view text, std::string_view allowed) {
    return text.find_first_not_of(allowed) == text.npos;
}

constexpr std::string_view digits = "0123456789";
constexpr std::uint16_t https_port = 443;

}  // namespace

std::string_view path_of(std::string_view target) {
    return target.substr(0, target.find('?'));
}

std::string query_value(std::string_view target, std::string_view parameter) {
    std::string_view query = target.substr(std::min(target.size(), path_of(target).size() + 1));
    while (!query.empty()) {
        const std::string_view part = query.substr(0, query.find('&'));
        if (part.starts_with(parameter) && part.substr(parameter.size()).starts_with('='))
            return decoded(part.substr(parameter.size() + 1));
        query.remove_prefix(std::min(query.size(), part.size() + 1));
    }
    return {};
}

std::string shown_token(const HttpRequest& request) {
    constexpr std::string_view bearer = "Bearer ";
    if (request.authorization.starts_with(bearer))
        return request.authorization.substr(bearer.size());
    return query_value(request.target, "token");
}

bool is_wrong_guess(const HttpRequest& request, const HttpAnswer& answer) {
    return answer.status == 401 && !(request.authorization.empty() && shown_token(request).empty());
}

bool accepts_encoding(std::string_view accept_encoding, std::string_view coding) {
    constexpr std::string_view blanks = " \t";
    while (!accept_encoding.empty()) {
        const std::size_t end = std::min(accept_encoding.find(','), accept_encoding.size());
        std::string_view part = accept_encoding.substr(0, end);
        accept_encoding.remove_prefix(std::min(end + 1, accept_encoding.size()));
        part.remove_prefix(std::min(part.find_first_not_of(blanks), part.size()));
        const std::string_view name = part.substr(0, part.find_first_of("; \t"));
        if (name != coding)
            continue;
        // "q=0" with any number of zeros refuses it.
        const std::size_t q = part.find("q=");
        return q == part.npos || part.find_first_of("123456789", q) != part.npos;
    }
    return false;
}

bool is_own_origin(std::string_view origin, std::string_view host) {
    constexpr std::string_view scheme = "https://";
    return origin.empty() || (origin.starts_with(scheme) && origin.substr(scheme.size()) == host);
}

PublicName parse_public_name(std::string_view text, std::uint16_t usual_port) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    PublicName result{in_small_letters(text.substr(0, colon)), usual_port};
    bool is_right = !result.name.empty() && result.name.front() != '.' &&
                    has_only(result.name, "abcdefghijklmnopqrstuvwxyz0123456789.-");
    if (colon < text.size()) {
        const std::string_view port = text.substr(colon + 1);
        const auto [end, error] =
            std::from_chars(port.data(), port.data() + port.size(), result.port);
        is_right = is_right && error == std::errc{} && end == port.data() + port.size() &&
                   result.port != 0;
    }
    if (!is_right)
        throw Error("'" + std::string(text) +
                    "' is no public name; write NAME or NAME:PORT, for example "
                    "or-3.hospital.example.");
    return result;
}

std::string origin_of(const PublicName& name) {
    return "https://" + name.name +
           (name.port == https_port ? "" : ":" + std::to_string(name.port));
}

bool is_named(std::string_view host, std::string_view public_name) {
    if (host.starts_with('[')) {
        const std::size_t end = host.find(']');
        if (end == host.npos || !has_only(host.substr(1, end - 1), "0123456789abcdefABCDEF:."))
            return false;
        const std::string_view rest = host.substr(end + 1);
        return rest.empty() || (rest[0] == ':' && has_only(rest.substr(1), digits));
    }
    const std::size_t colon = std::min(host.find(':'), host.size());
    if (!has_only(host.substr(std::min(colon + 1, host.size())), digits))
        return false;
    std::string name = in_small_letters(host.substr(0, colon));
    if (name.ends_with('.'))
        name.pop_back();
    const bool is_address =
        has_only(name, "0123456789.") && std::count(name.begin(), name.end(), '.') == 3;
    return name == public_name || name == "localhost" || is_address;
}

}  // namespace theatron::net
