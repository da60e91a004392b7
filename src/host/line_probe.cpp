// SPDX-License-Identifier: Apache-2.0
#include "host/line_probe.h"

#include <algorithm>
#include <charconv>
#include <random>
#include <string>
#include <utility>

namespace theatron::host {
namespace {

net::HttpAnswer busy() {
    return {.status = 429,
            .body = "Others measure their line at present; try again in half a minute.\n",
            .headers = {{"Retry-After", "30"}}};
}

std::string noise(std::size_t bytes) {
    std::minstd_rand random(1);
    std::string result(bytes, '\0');
    for (char& c : result)
        c = char(random() >> 8);
    return result;
}

}  // namespace

bool LineProbe::is_line(const net::HttpRequest& request) {
    return net::path_of(request.target) == "/line";
}

bool LineProbe::take(std::uint64_t bytes, TimePoint now) {
    return bytes_.take(now, double(std::max(bytes, least_bytes)));
}

net::HttpAnswer LineProbe::answer(const net::HttpRequest& request, TimePoint now) {
    const std::string asked = net::query_value(request.target, "bytes");
    std::uint64_t bytes = 0;
    const auto [end, error] = std::from_chars(asked.data(), asked.data() + asked.size(), bytes);
    const bool is_number = error == std::errc() && end == asked.data() + asked.size();
    if (!asked.empty() && (!is_number || bytes > max_answer_bytes))
        return {.status = 400,
                .body = "Ask for 0 to " + std::to_string(max_answer_bytes) + " bytes.\n"};
    if (!take(bytes, now))
        return busy();
    return {.type = "application/octet-stream", .body = noise(std::size_t(bytes))};
}

net::HttpAnswer LineProbe::take_body(std::uint64_t bytes, TimePoint now) {
    if (bytes > max_body_bytes)
        return {.status = 413,
                .body = "Send at most " + std::to_string(max_body_bytes) + " bytes.\n"};
    return take(bytes, now) ? net::HttpAnswer{.status = 204} : busy();
}

}  // namespace theatron::host
