// SPDX-License-Identifier: Apache-2.0
#include "host/lobby.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "files/json_text.h"
#include "host/bearer.h"
#include "host/host_http.h"
#include "host/whose_published.h"
#include "wire/condition_text.h"

namespace theatron::host {
namespace {

constexpr std::string_view lobby_path = "/lobby", thumbnail_path = "/thumbnail";

}  // namespace

bool is_lobby(const net::HttpRequest& request) {
    const std::string_view path = net::path_of(request.target);
    return path == lobby_path || path == thumbnail_path;
}

nlohmann::json lobby_session(const HostFigures& figures, const LobbyGuest& guest,
                             const std::string& thumbnail) {
    nlohmann::json session{{"name", figures.name},
                           {"asks", guest.must_ask},
                           {"ended", figures.has_ended},
                           {"people_count", figures.participants.size()}};
    if (guest.is_held_back)
        session["held_back"] = true;
    if (!guest.sees_inside() || figures.has_ended)
        return session;
    nlohmann::json people = nlohmann::json::array(), cameras = nlohmann::json::array();
    for (const auto& person : figures.participants)
        people.push_back(
            {{"name", person.name}, {"role", wire::text_of(person.role)}, {"muted", person.muted}});
    for (std::size_t i = 0; i < figures.cameras.size(); ++i)
        cameras.push_back({{"name", figures.cameras[i].lane.name},
                           {"state", wire::text_of(figures.cameras[i].lane.camera.condition)},
                           {"adjusted", figures.adjustment(CameraId(i))}});
    for (const auto& camera : figures.published)
        if (!camera.is_face)
            cameras.push_back({{"name", whose_camera(figures, camera)},
                               {"state", wire::text_of(camera.condition)},
                               {"adjusted", figures.adjustment(camera.id)}});
    session["people"] = people;
    session["cameras"] = cameras;
    session["thumbnail"] = thumbnail;
    return session;
}

nlohmann::json lobby_session(const ClosedSession& session) {
    return {{"name", session.name}, {"closed", true}, {"problem", session.problem}};
}

nlohmann::json lobby_json(const HostFigures& figures, const LobbyGuest& guest) {
    return {{"role", wire::text_of(guest.role)},
            {"sessions",
             nlohmann::json::array({lobby_session(figures, guest, std::string(thumbnail_path))})}};
}

net::HttpAnswer answer_lobby(const net::HttpRequest& request,
                             const SessionSwitch::Sessions& sessions,
                             const std::vector<ClosedSession>& closed) {
    const std::string secret = net::shown_token(request);
    const auto bearer = find_bearer(secret, sessions);
    if (!bearer)
        return {.status = 401, .body = "Show the token of a link: docs/room.md\n"};
    const auto* own = bearer->session;
    const wire::Role role = bearer->token.role;
    const LobbyGuest guest{role, own->second.must_ask(role), own->second.is_held_back(secret)};
    const bool sees_all =
        own == &sessions.front() && role == wire::Role::operator_ && !guest.is_held_back;

    if (net::path_of(request.target) == lobby_path) {
        nlohmann::json lobby = lobby_json(own->second.figures(), guest);
        for (const auto& [number, session] : sessions)
            if (sees_all && number != own->first)
                lobby["sessions"].push_back(
                    lobby_session(session.figures(), {role},
                                  std::string(thumbnail_path) +
                                      "?session=" + std::to_string(std::uint32_t(number))));
        for (const ClosedSession& session : closed)
            if (sees_all)
                lobby["sessions"].push_back(lobby_session(session));
        return {.type = "application/json", .body = files::json_text(lobby) + "\n"};
    }
    const std::string asked = net::query_value(request.target, "session");
    std::string picture;
    bool may_see = false;
    for (const auto& [number, session] : sessions) {
        const bool is_own = number == own->first;
        const bool is_meant =
            asked.empty() ? is_own : asked == std::to_string(std::uint32_t(number));
        // The operating room goes on without the people of an ended session.
        if (is_meant && (is_own ? guest.sees_inside() : sees_all) && !session.figures().has_ended)
            may_see = true, picture = session.picture(0);
    }
    // A page that asks again and again would fill its browser's console with errors.
    if (may_see && picture.empty())
        return {.status = 204};
    if (picture.empty())
        return {.status = 404, .body = "There is no picture.\n"};
    return {.type = "image/png", .body = std::move(picture)};
}

nlohmann::json lobby_of_host(const net::Link& link, Duration patience) {
    return json_of_host(link, std::string(lobby_path), "lobby", patience);
}

std::optional<std::string> thumbnail_of_host(const net::Link& link, Duration patience,
                                             const std::string& address) {
    // The address comes from the host's answer.
    if (net::path_of(address) != thumbnail_path)
        return std::nullopt;
    net::HttpsAnswer answer = net::https_get(link, address, patience);
    require_known_token(answer);
    if (answer.status != 200)
        return std::nullopt;
    return std::move(answer.body);
}

}  // namespace theatron::host
