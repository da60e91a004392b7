// SPDX-License-Identifier: Apache-2.0
#include "entry.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "link_argument.h"
#include "lobby_fields.h"
#include "lobby_watch.h"
#include "phrases/phrase.h"
#include "wire/role.h"
#include "wire/sentence.h"

namespace theatron::app {
namespace {

// Names of at most six, with what else is known of each: "table (live), lamp (live), and 1 more".
std::string named_text(const std::vector<std::string>& names,
                       const std::vector<std::string>& details) {
    constexpr std::size_t named = 6;
    std::string line;
    for (std::size_t i = 0; i < std::min(names.size(), named); ++i)
        line += (i > 0 ? ", " : "") + names[i] + " (" + details[i] + ")";
    return names.size() > named
               ? say(Phrase::form_and_more, line, std::to_string(names.size() - named))
               : line;
}

// "3 cameras: table (live), lamp (live), and 1 more", from a list of the lobby.
template <class DetailOf>
std::string list_text(const nlohmann::json& session, const char* list, Phrase one, Phrase many,
                      const DetailOf& detail_of) {
    if (!session.contains(list) || !session[list].is_array() || session[list].empty())
        return {};
    std::vector<std::string> names, details;
    for (const nlohmann::json& entry : session[list]) {
        names.push_back(text_field(entry, "name"));
        details.push_back(detail_of(entry));
    }
    return say(names.size() == 1 ? one : many, named_text(names, details),
               std::to_string(names.size()));
}

std::string role_text(const nlohmann::json& person) {
    const std::string role = text_field(person, "role");
    const auto known = wire::parse_role(role);
    return known ? wire::spoken(*known) : role;
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

window::EntryFacts problem_facts(const std::string& problem) {
    window::EntryFacts facts;
    facts.hint = problem;
    facts.is_problem = true;
    return facts;
}

window::EntryFacts facts_without_answer(const ReadLink& read) {
    if (!read.problem.empty())
        return problem_facts(read.problem);
    window::EntryFacts facts;
    facts.hint = read.link ? say(Phrase::form_asking, read.link->host) : say(Phrase::form_ask_link);
    return facts;
}

std::vector<window::EntryRecent> shown(const client::RecentLinks& recents) {
    std::vector<window::EntryRecent> shown;
    for (const client::RecentLink& recent : recents)
        shown.push_back({recent.session, client::recent_link_text(recent)});
    return shown;
}

std::string presence_text(const nlohmann::json& session) {
    if (is_field_set(session, "closed"))
        return say(Phrase::form_not_open);
    const bool has_count =
        session.contains("people_count") && session["people_count"].is_number_integer();
    const auto people = has_count ? session["people_count"].get<std::int64_t>() : 0;
    return people <= 0   ? say(Phrase::form_nobody)
           : people == 1 ? say(Phrase::form_person_count)
                         : say(Phrase::form_people_count, std::to_string(people));
}

// "Also here: OR 4 (2 people), OR 5 (nobody), OR 6 (not open)", of the other sessions that the
// link's bearer may see.
std::string others_text(const nlohmann::json& sessions) {
    std::vector<std::string> names, presences;
    for (std::size_t i = 1; i < sessions.size(); ++i) {
        names.push_back(text_field(sessions[i], "name"));
        presences.push_back(presence_text(sessions[i]));
    }
    return names.empty() ? "" : say(Phrase::form_also_here, named_text(names, presences));
}

}  // namespace

window::EntryFacts entry_facts(const nlohmann::json& lobby) {
    if (!lobby.contains("sessions") || !lobby["sessions"].is_array() || lobby["sessions"].empty())
        return problem_facts(say(Phrase::form_no_session));
    const nlohmann::json& session = lobby["sessions"][0];
    if (is_field_set(session, "ended"))
        return problem_facts(say(Phrase::form_ended));
    window::EntryFacts facts;
    facts.title = text_field(session, "name");
    facts.can_enter = true;
    const std::string role = text_field(lobby, "role");
    const auto known = wire::parse_role(role);
    facts.lines.push_back(known == wire::Role::observer
                              ? say(Phrase::form_as_observer)
                              : say(Phrase::form_come_as, known ? wire::spoken_with_article(*known)
                                                          : role.empty() ? say(Phrase::form_a_guest)
                                                                         : role));
    const std::string people =
        list_text(session, "people", Phrase::form_one_person, Phrase::form_people, role_text);
    if (!people.empty())
        facts.lines.push_back(people);
    else if (session.contains("people"))
        facts.lines.push_back(say(Phrase::form_nobody_yet));
    // The states are words of the host, "live" for most.
    if (const std::string cameras =
            list_text(session, "cameras", Phrase::form_one_camera, Phrase::form_cameras,
                      [](const nlohmann::json& camera) { return text_field(camera, "state"); });
        !cameras.empty())
        facts.lines.push_back(cameras);
    if (is_field_set(session, "held_back"))
        facts.lines.push_back(say(Phrase::form_held_back));
    if (const std::string others = others_text(lobby["sessions"]); !others.empty())
        facts.lines.push_back(others);
    facts.hint =
        say(is_field_set(session, "asks") ? Phrase::form_must_knock : Phrase::form_is_open);
    return facts;
}

std::optional<Entered> ask_entry(window::DesktopWindow& window, window::EntryFields fields,
                                 const std::string& problem, client::RecentLinks recents,
                                 const std::function<void(const std::string& link)>& forget) {
    window.set_title(say(Phrase::form_title) + " - Theatron");
    window::EntryForm form(fields, {[&] { return window.clipboard(); },
                                    [&](const std::string& text) { window.set_clipboard(text); }});
    form.set_recents(shown(recents));
    LobbyWatch watch([&] { window.wake(); });
    ReadLink read = read_link(fields.link);
    watch.set_link(read.link);
    window::EntryFacts facts =
        problem.empty() ? facts_without_answer(read) : problem_facts(problem);
    bool must_draw = true;
    while (!cli::stop_requested()) {
        window.wait(form.is_animated() ? window.picture_time() : Duration(500ms));
        const window::FormInput input = window.poll_form();
        if (input.close)
            break;
        if (auto answer = watch.take()) {
            const window::EntryFacts newest = answer->problem.empty()
                                                  ? entry_facts(answer->lobby)
                                                  : problem_facts(answer->problem);
            form.set_picture(newest.can_enter ? answer->picture.view() : ColorView{});
            must_draw = must_draw || newest != facts;
            facts = newest;
        }
        if (!must_draw && input.is_empty() && !form.is_animated())
            continue;
        const window::EntryAnswer pressed =
            form.draw(facts, input, window.pixels(), window.text_pixels(), steady_now());
        must_draw = false;
        if (pressed == window::EntryAnswer::leave)
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
        if (pressed == window::EntryAnswer::enter && read.link) {
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
