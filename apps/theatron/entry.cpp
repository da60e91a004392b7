// SPDX-License-Identifier: Apache-2.0
#include "entry.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "link_argument.h"
#include "lobby_fields.h"
#include "lobby_watch.h"
#include "phrases/phrase.h"

namespace theatron::app {
namespace {

constexpr const char* ask_for_link =
    "Paste the link that the host printed or that somebody sent to you.";

// "3 cameras: table (live), lamp (live), and 1 more", from a list of the lobby.
std::string list_text(const nlohmann::json& session, const char* list, const char* field,
                      const char* one, const char* many) {
    constexpr std::size_t named = 6;
    if (!session.contains(list) || !session[list].is_array() || session[list].empty())
        return {};
    const std::size_t count = session[list].size();
    std::string line = std::to_string(count) + " " + (count == 1 ? one : many) + ": ";
    for (std::size_t i = 0; i < std::min(count, named); ++i)
        line += (i > 0 ? ", " : "") + text_field(session[list][i], "name") + " (" +
                text_field(session[list][i], field) + ")";
    return count > named ? line + ", and " + std::to_string(count - named) + " more" : line;
}

// A parsed link, or the reason why the typed text is none; neither where nothing was typed.
struct ReadLink {
    std::optional<net::Link> link;
    std::string problem;
};
ReadLink read_link(const std::string& typed) {
    const auto begin = typed.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos)
        return {};
    const auto end = typed.find_last_not_of(" \t\r\n");
    try {
        return {parse_link_argument(typed.substr(begin, end - begin + 1)), {}};
    } catch (const Error& error) {
        return {std::nullopt, error.what()};
    }
}

xr::EntryFacts problem_facts(const std::string& problem) {
    xr::EntryFacts facts;
    facts.hint = problem;
    facts.is_problem = true;
    return facts;
}

xr::EntryFacts facts_without_answer(const ReadLink& read) {
    if (!read.problem.empty())
        return problem_facts(read.problem);
    xr::EntryFacts facts;
    facts.hint = read.link ? "Asking the host at " + read.link->host + "..." : ask_for_link;
    return facts;
}

std::vector<xr::EntryRecent> shown(const client::RecentLinks& recents) {
    std::vector<xr::EntryRecent> shown;
    for (const client::RecentLink& recent : recents)
        shown.push_back({recent.session, client::recent_link_text(recent)});
    return shown;
}

std::string presence_text(const nlohmann::json& session) {
    if (is_field_set(session, "closed"))
        return "not open";
    const bool has_count =
        session.contains("people_count") && session["people_count"].is_number_integer();
    const auto people = has_count ? session["people_count"].get<std::int64_t>() : 0;
    return people <= 0 ? "nobody" : people == 1 ? "1 person" : std::to_string(people) + " people";
}

// "Also here: OR 4 (2 people), OR 5 (nobody), OR 6 (not open)", of the other sessions that the
// link's bearer may see.
std::string others_text(const nlohmann::json& sessions) {
    constexpr std::size_t named = 6;
    std::string line;
    for (std::size_t i = 1; i < sessions.size() && i <= named; ++i) {
        const nlohmann::json& session = sessions[i];
        line += (line.empty() ? "Also here: " : ", ") + text_field(session, "name") + " (" +
                presence_text(session) + ")";
    }
    return sessions.size() > named + 1
               ? line + ", and " + std::to_string(sessions.size() - named - 1) + " more"
               : line;
}

}  // namespace

xr::EntryFacts entry_facts(const nlohmann::json& lobby) {
    if (!lobby.contains("sessions") || !lobby["sessions"].is_array() || lobby["sessions"].empty())
        return problem_facts("The host has no session for this link.");
    const nlohmann::json& session = lobby["sessions"][0];
    if (is_field_set(session, "ended"))
        return problem_facts("This session has ended. Ask for a new link.");
    xr::EntryFacts facts;
    facts.title = text_field(session, "name");
    facts.can_enter = true;
    const std::string role = text_field(lobby, "role");
    facts.lines.push_back("You come as " +
                          std::string(role == "expert" || role == "operator" ? "an " : "a ") +
                          (role.empty() ? "guest" : role) + ".");
    if (role == "observer")
        facts.lines.back() = "You come as an observer: you see and hear, and are not heard.";
    const std::string people = list_text(session, "people", "role", "person", "people");
    if (!people.empty())
        facts.lines.push_back(people);
    else if (session.contains("people"))
        facts.lines.push_back("Nobody else is there yet.");
    if (const std::string cameras = list_text(session, "cameras", "state", "camera", "cameras");
        !cameras.empty())
        facts.lines.push_back(cameras);
    if (is_field_set(session, "held_back"))
        facts.lines.push_back(held_back);
    if (const std::string others = others_text(lobby["sessions"]); !others.empty())
        facts.lines.push_back(others);
    facts.hint = is_field_set(session, "asks") ? "An operator lets you in after you have knocked."
                                               : "The session is open.";
    return facts;
}

std::optional<Entered> ask_entry(xr::DesktopWindow& window, xr::EntryFields fields,
                                 const std::string& problem, client::RecentLinks recents,
                                 const std::function<void(const std::string& link)>& forget) {
    window.set_title("Enter a session - Theatron");
    xr::EntryForm form(fields, {[&] { return window.clipboard(); },
                                [&](const std::string& text) { window.set_clipboard(text); }});
    form.set_recents(shown(recents));
    LobbyWatch watch([&] { window.wake(); });
    ReadLink read = read_link(fields.link);
    watch.set_link(read.link);
    xr::EntryFacts facts = problem.empty() ? facts_without_answer(read) : problem_facts(problem);
    bool must_draw = true;
    while (!cli::stop_requested()) {
        window.wait(form.is_animated() ? window.picture_time() : Duration(500ms));
        const xr::FormInput input = window.poll_form();
        if (input.close)
            break;
        if (auto answer = watch.take()) {
            const xr::EntryFacts newest = answer->problem.empty() ? entry_facts(answer->lobby)
                                                                  : problem_facts(answer->problem);
            form.set_picture(newest.can_enter ? answer->picture.view() : ColorView{});
            must_draw = must_draw || newest != facts;
            facts = newest;
        }
        if (!must_draw && input.is_empty() && !form.is_animated())
            continue;
        const xr::EntryAnswer pressed =
            form.draw(facts, input, window.pixels(), window.text_pixels(), steady_now());
        must_draw = false;
        if (pressed == xr::EntryAnswer::leave)
            break;
        if (const auto recent = form.take_recent()) {
            const std::string link = recents.at(recent->index).link;
            if (recent->forgets) {
                recents.erase(recents.begin() + std::ptrdiff_t(recent->index));
                form.set_recents(shown(recents));
                forget(link);
            } else {
                form.set_hidden_link(link);
            }
            must_draw = true;
        }
        if (form.fields().link != fields.link) {
            read = read_link(form.fields().link);
            watch.set_link(read.link);
            facts = facts_without_answer(read);
            form.set_picture({});
            must_draw = true;
        }
        fields = form.fields();
        if (pressed == xr::EntryAnswer::enter && read.link) {
            // Opening sound and connection takes a while: the press is seen to have been taken.
            facts.hint = say(Phrase::connecting);
            facts.can_enter = false;
            facts.is_problem = false;
            form.draw(facts, {}, window.pixels(), window.text_pixels(), steady_now());
            window.present();
            return Entered{*read.link, fields};
        }
        window.present();
    }
    return std::nullopt;
}

}  // namespace theatron::app
