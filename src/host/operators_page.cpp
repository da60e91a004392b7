// SPDX-License-Identifier: Apache-2.0
#include "host/operators_page.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "files/json_text.h"
#include "files/utc_text.h"
#include "host/bearer.h"
#include "host/qr_code.h"
#include "host/session_folder.h"
#include "host/whose_published.h"
#include "wire/condition_text.h"

namespace theatron::host {
namespace {

constexpr std::string_view facts_path = "/operators/facts", picture_path = "/operators/picture",
                           link_path = "/operators/link", person_path = "/operators/person",
                           recording_path = "/operators/recording",
                           session_path = "/operators/session";
constexpr double max_hours = 10'000;

using Sessions = SessionSwitch::Sessions;
using net::HttpAnswer, net::HttpRequest;
using session::AuditEvent, session::event_of_session;

// The bearer of an operator's link.
struct Operator {
    const Sessions::value_type* own = nullptr;
    bool sees_all = false;
    std::string link;  // the name of the link
    std::string by() const { return "page of " + link; }
};

HttpAnswer refusal(int status, std::string sentence) {
    return {.status = status, .body = std::move(sentence) + "\n"};
}

HttpAnswer json_answer(const nlohmann::json& json) {
    return {.type = "application/json", .body = files::json_text(json) + "\n"};
}

// Why the request shows nothing; nullopt for an operator, whom `who` then names.
std::optional<HttpAnswer> refuse(const HttpRequest& request, const Sessions& sessions,
                                 Operator& who) {
    const std::string secret = net::shown_token(request);
    const auto bearer = find_bearer(secret, sessions);
    if (!bearer)
        return refusal(401, "The host does not know this link; ask for an operator's link.");
    if (bearer->has_expired())
        return refusal(410, "This link has expired; ask for a new one.");
    if (bearer->session->second.is_held_back(secret))
        return refusal(403, "Somebody who came by this link was removed: docs/room.md");
    if (bearer->token.role != wire::Role::operator_)
        return refusal(403, "This page is for operators; open it by an operator's link.");
    who = {bearer->session, bearer->session == &sessions.front(), bearer->token.link};
    return std::nullopt;
}

template <class Number>
std::optional<Number> number_in(const std::string& text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(number)
                                                                    : std::nullopt;
}

// Null: there is none of this number that the operator sees.
const PortSession* meant_session(const HttpRequest& request, const Sessions& sessions,
                                 const Operator& who) {
    const std::string asked = net::query_value(request.target, "session");
    if (asked.empty())
        return &who.own->second;
    for (const auto& entry : sessions)
        if (asked == std::to_string(std::uint32_t(entry.first)))
            return who.sees_all || &entry == who.own ? &entry.second : nullptr;
    return nullptr;
}

nlohmann::json link_json(const KnownLink& link, const std::string& own) {
    return {{"name", link.name},
            {"role", wire::text_of(link.role)},
            {"until", link.expires ? files::utc_text(*link.expires) : ""},
            {"expired", link.has_expired(files::utc_now())},
            {"for", link.label},
            {"is_own", link.name == own}};
}

nlohmann::json recording_json(const PortSession& session) {
    const RecordingProgram::State state = session.recording().state(steady_now());
    const nlohmann::json free = state.free_bytes ? nlohmann::json(*state.free_bytes) : nullptr;
    return {
        {"phase", text_of(state.phase)}, {"file", state.file.string()}, {"seconds", state.seconds},
        {"bytes", state.bytes},          {"free_bytes", free},          {"problem", state.problem}};
}

nlohmann::json cameras_json(const HostFigures& figures) {
    nlohmann::json cameras = nlohmann::json::array();
    for (const auto& camera : figures.cameras)
        cameras.push_back({{"name", camera.lane.name},
                           {"state", wire::text_of(camera.lane.camera.condition)},
                           {"problem", wire::english(camera.lane.camera.problem)},
                           {"fps", camera.lane.frames_per_second},
                           {"age_ms", camera.lane.age_seconds * 1000},
                           {"has_picture", true}});
    for (const auto& camera : figures.published)
        cameras.push_back({{"name", whose_camera(figures, camera)},
                           {"state", wire::text_of(camera.condition)},
                           {"problem", ""},
                           {"has_picture", false}});
    return cameras;
}

nlohmann::json problems_json(const HostFigures& figures) {
    nlohmann::json problems = nlohmann::json::array();
    for (const std::string& problem :
         {figures.problems.audit_log, figures.problems.room, figures.problems.links,
          figures.registration.problem, figures.page_problem})
        if (!problem.empty())
            problems.push_back(problem);
    for (const std::string& problem : figures.case_problems)
        problems.push_back(problem);
    for (const auto& certificate : figures.certificates)
        if (!certificate.problem.empty())
            problems.push_back(certificate.problem);
    return problems;
}

nlohmann::json session_json(const Sessions::value_type& entry, const Operator& who, bool is_first) {
    const auto& [number, session] = entry;
    const HostFigures figures = session.figures();
    const bool is_own = &entry == who.own;
    nlohmann::json people = nlohmann::json::array(), visitors = nlohmann::json::array(),
                   links = nlohmann::json::array();
    for (const auto& person : figures.participants)
        people.push_back({{"id", int(person.id)},
                          {"name", person.name},
                          {"role", wire::text_of(person.role)},
                          {"muted", person.muted},
                          {"hand", person.hand_raised}});
    for (const wire::Visitor& visitor : figures.visitors)
        visitors.push_back(visitor_json(visitor));
    for (const KnownLink& link : session.links())
        links.push_back(link_json(link, is_own ? who.link : ""));
    return {{"number", std::uint32_t(number)},
            {"name", figures.name},
            {"is_own", is_own},
            {"may_end", who.sees_all && !is_first},
            {"ended", figures.has_ended},
            {"cameras", cameras_json(figures)},
            {"people", people},
            {"visitors", visitors},
            {"links", links},
            {"recording", recording_json(session)},
            {"problems", problems_json(figures)}};
}

// `hours` of the request; nullopt: without an end. Throws Error.
std::optional<files::UtcSeconds> end_of_link(const HttpRequest& request) {
    const std::string text = net::query_value(request.target, "hours");
    if (text.empty())
        return std::nullopt;
    const auto hours = number_in<double>(text);
    if (!hours || !(*hours > 0) || *hours > max_hours)
        throw Error("A link is valid for a number of hours greater than 0 and up to 10000.");
    return files::utc_now() + files::UtcSeconds(std::llround(*hours * 3600));
}

// `own`: the name of the link by which the page is open, if it is of this session.
nlohmann::json shown_link(const KnownLink& link, const std::string& own, const net::Link& address) {
    nlohmann::json json = link_json(link, own);
    json["link"] = link_text(link, address);
    json["qr"] = qr_rows(json["link"]);
    return json;
}

// Throws Error.
HttpAnswer act_on_link(const HttpRequest& request, const PortSession& session, const Operator& who,
                       const net::Link& address) {
    const auto value = [&](const char* key) { return net::query_value(request.target, key); };
    const std::string own = &session == &who.own->second ? who.link : "";
    if (const auto role = wire::parse_role(value("role")))
        return json_answer(shown_link(
            session.make_link(*role, end_of_link(request), value("for"), who.by()), own, address));
    const std::string shown = value("show"), revoked = value("revoke");
    if (shown.empty() && revoked.empty())
        return refusal(400, "Say the role of a new link, or which one is shown or revoked.");
    const std::vector<KnownLink> links = session.links();
    const auto known = std::ranges::find(links, shown.empty() ? revoked : shown, &KnownLink::name);
    if (known == links.end())
        return refusal(404, "There is no such link any more.");
    if (!shown.empty())
        return json_answer(shown_link(*known, own, address));
    if (known->name == own)
        return refusal(409,
                       "This page is open by that link. Open it by another operator's link to "
                       "revoke this one.");
    session.revoke_link(known->name, who.by());
    return {.status = 204};
}

bool is_there(const HostFigures& figures, ParticipantId id) {
    return std::ranges::any_of(figures.participants,
                               [&](const auto& person) { return person.id == id; }) ||
           std::ranges::any_of(figures.visitors,
                               [&](const auto& visitor) { return visitor.participant == id; });
}

bool came_by(const HostFigures& figures, ParticipantId id, const std::string& link) {
    return std::ranges::any_of(figures.participants, [&](const auto& person) {
        return person.id == id && person.link == link;
    });
}

HttpAnswer act_on_person(const HttpRequest& request, const PortSession& session,
                         const Operator& who) {
    using wire::ManageAction;
    constexpr std::pair<const char*, ManageAction> actions[] = {
        {"admit", ManageAction::admit},   {"turn_away", ManageAction::turn_away},
        {"mute", ManageAction::mute},     {"unmute", ManageAction::unmute},
        {"remove", ManageAction::remove}, {"lower", ManageAction::lower_hand},
    };
    const auto id = number_in<std::uint32_t>(net::query_value(request.target, "id"));
    const std::string asked = net::query_value(request.target, "do");
    const auto action =
        std::ranges::find_if(actions, [&](const auto& known) { return asked == known.first; });
    if (!id || *id == 0 || action == std::end(actions))
        return refusal(400, "Say whom this is about, and what is to be done.");
    const HostFigures figures = session.figures();
    if (!is_there(figures, ParticipantId(*id)))
        return refusal(404, "That person has left.");
    // The host shows nothing by the link of somebody who is kept out.
    if (action->second == ManageAction::remove && &session == &who.own->second &&
        came_by(figures, ParticipantId(*id), who.link))
        return refusal(409,
                       "That person came by the link by which this page is open, which would be "
                       "closed, too. Open it by another operator's link to remove them.");
    session.manage(action->second, ParticipantId(*id), who.by());
    return {.status = 204};
}

// By a link of its own, which no other decision takes away: it may record, and does not wait at the
// door. Throws Error.
std::string start_recording(const PortSession& session, net::Link address, const std::string& by) {
    constexpr files::UtcSeconds valid_for_joining = 24 * 3600;
    session.recording().require_ready(steady_now());
    const KnownLink link =
        session.make_link(wire::Role::publisher, files::utc_now() + valid_for_joining,
                          "the recording of the operators' page", by);
    try {
        return session.recording()
            .start(link_text(link, std::move(address)), link.name, session.figures().name,
                   steady_now())
            .filename()
            .string();
    } catch (const Error&) {
        session.revoke_link(link.name, by);
        throw;
    }
}

// Throws Error.
HttpAnswer act_on_recording(const HttpRequest& request, const PortSession& session,
                            const Operator& who, const net::Link& address) {
    const std::string asked = net::query_value(request.target, "do");
    if (asked == "stop")
        return session.recording().stop() ? HttpAnswer{.status = 204}
                                          : refusal(409, "Nothing is being recorded.");
    if (asked != "start")
        return refusal(400, "A recording is started or stopped.");
    const std::string file = start_recording(session, address, who.by());
    session.audit(event_of_session(AuditEvent::What::recording_begun, who.by(), file));
    return {.status = 204};
}

// Throws Error.
HttpAnswer act_on_sessions(const HttpRequest& request, const Operator& who,
                           const std::filesystem::path& state) {
    using What = AuditEvent::What;
    const auto audit = [&](What what, const std::string& name) {
        who.own->second.audit(event_of_session(what, who.by(), name));
    };
    const std::string created = net::query_value(request.target, "create"),
                      ended = net::query_value(request.target, "end");
    if (created.empty() && ended.empty())
        return refusal(400, "Say which session is made or ended.");
    if (!created.empty()) {
        create_session(state, created, {});
        audit(What::created, created);
    } else if (find_session_folder(state, ended) != state) {
        ask_for_end(state, ended);
        audit(What::end_asked, ended);
    } else {
        return refusal(409, "The first session ends with its host.");
    }
    return {.status = 204};
}

}  // namespace

bool is_of_operators(const HttpRequest& request) {
    return net::path_of(request.target).starts_with("/operators/");
}

HttpAnswer answer_operator(const HttpRequest& request, const Sessions& sessions,
                           const std::vector<ClosedSession>& closed) {
    Operator who;
    if (auto refused = refuse(request, sessions, who))
        return std::move(*refused);
    const std::string_view path = net::path_of(request.target);
    if (path == picture_path) {
        const PortSession* session = meant_session(request, sessions, who);
        const auto camera = number_in<std::uint32_t>(net::query_value(request.target, "camera"));
        if (!session || !camera)
            return refusal(404, "There is no such camera.");
        std::string picture = session->picture(*camera);
        if (picture.empty())
            return {.status = 204};
        return {.type = "image/png", .body = std::move(picture)};
    }
    if (path != facts_path)
        return refusal(404, "There is nothing here.");
    nlohmann::json shown = nlohmann::json::array(), not_open = nlohmann::json::array();
    for (const auto& entry : sessions)
        if (who.sees_all || &entry == who.own)
            shown.push_back(session_json(entry, who, &entry == &sessions.front()));
    for (const ClosedSession& session : closed)
        if (who.sees_all)
            not_open.push_back({{"name", session.name}, {"problem", session.problem}});
    return json_answer({{"own", std::uint32_t(who.own->first)},
                        {"sessions", shown},
                        {"closed", not_open},
                        {"may_create", who.sees_all}});
}

HttpAnswer act_for_operator(const HttpRequest& request, const Sessions& sessions,
                            const OperatorsHost& host) {
    Operator who;
    if (auto refused = refuse(request, sessions, who))
        return std::move(*refused);
    const std::string_view path = net::path_of(request.target);
    const PortSession* session = meant_session(request, sessions, who);
    if (!session)
        return refusal(404, "There is no such session any more.");
    try {
        if (path == link_path)
            return act_on_link(request, *session, who, host.address);
        if (path == person_path)
            return act_on_person(request, *session, who);
        if (path == recording_path)
            return act_on_recording(request, *session, who, host.own);
        if (path == session_path)
            return who.sees_all
                       ? act_on_sessions(request, who, host.state_folder)
                       : refusal(403, "Sessions are made and ended by operators of the first one.");
    } catch (const Error& error) {
        return refusal(409, error.what());
    }
    return refusal(404, "There is nothing here.");
}

}  // namespace theatron::host
