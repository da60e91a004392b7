// SPDX-License-Identifier: Apache-2.0
#include "host/lobby.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "files/json_text.h"
#include "host/host_http.h"
#include "host/host_impl.h"
#include "wire/condition_text.h"

namespace theatron::host {
namespace {

constexpr std::string_view lobby_path = "/lobby", thumbnail_path = "/thumbnail";

}  // namespace

bool is_lobby(const net::HttpRequest& request) {
    const std::string_view path = net::path_of(request.target);
    return path == lobby_path || path == thumbnail_path;
}

nlohmann::json lobby_json(const HostFigures& figures, wire::Role role, bool must_ask) {
    nlohmann::json session{{"name", figures.name},
                           {"asks", must_ask},
                           {"ended", figures.has_ended},
                           {"people_count", figures.participants.size()}};
    if (!must_ask) {
        nlohmann::json people = nlohmann::json::array(), cameras = nlohmann::json::array();
        for (const auto& person : figures.participants)
            people.push_back({{"name", person.name},
                              {"role", wire::text_of(person.role)},
                              {"muted", person.muted}});
        for (std::size_t i = 0; i < figures.cameras.size(); ++i)
            cameras.push_back({{"name", figures.cameras[i].lane.name},
                               {"state", wire::text_of(figures.cameras[i].lane.camera.condition)},
                               {"adjusted", figures.adjustment(CameraId(i))}});
        for (const auto& camera : figures.published)
            if (!camera.is_face)
                cameras.push_back({{"name", camera.name},
                                   {"state", wire::text_of(camera.condition)},
                                   {"adjusted", figures.adjustment(camera.id)}});
        session["people"] = people;
        session["cameras"] = cameras;
        session["thumbnail"] = thumbnail_path;
    }
    return {{"role", wire::text_of(role)}, {"sessions", nlohmann::json::array({session})}};
}

std::optional<session::Admission::Token> Host::Impl::find_token(const std::string& secret) const {
    std::optional<session::Admission::Token> found;
    const std::lock_guard lock(tokens_mutex);
    for (const auto& token : tokens)
        if (net::equal_secrets(secret, token.secret))
            found = token;
    return found;
}

// On the door's thread.
net::HttpAnswer Host::Impl::answer_lobby(const net::HttpRequest& request) {
    const auto token = find_token(net::shown_token(request));
    if (!token)
        return {.status = 401, .body = "Show the token of a link: docs/room.md\n"};
    if (net::path_of(request.target) == lobby_path)
        return {
            .type = "application/json",
            .body =
                files::json_text(lobby_json(figures(), token->role, must_ask(token->role))) + "\n"};
    std::string picture = must_ask(token->role) ? std::string() : thumbnail.png();
    if (picture.empty())
        return {.status = 404, .body = "There is no picture.\n"};
    return {.type = "image/png", .body = std::move(picture)};
}

nlohmann::json lobby_of_host(const net::Link& link, Duration patience) {
    return json_of_host(link, std::string(lobby_path), "lobby", patience);
}

std::optional<std::string> thumbnail_of_host(const net::Link& link, Duration patience) {
    net::HttpsAnswer answer = net::https_get(link, std::string(thumbnail_path), patience);
    require_known_token(answer);
    if (answer.status != 200)
        return std::nullopt;
    return std::move(answer.body);
}

}  // namespace theatron::host
