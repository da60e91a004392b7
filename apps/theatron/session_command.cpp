// SPDX-License-Identifier: Apache-2.0
// theatron session
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/steady_clock.h"
#include "commands.h"
#include "files/json_text.h"
#include "host/audit_log.h"
#include "host/host_identity.h"
#include "host/link_book.h"
#include "host/session_folder.h"
#include "session_flags.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;
using host::ToldSession;

// A camera may take long to open; a session ends within seconds.
constexpr Duration new_session_patience = std::chrono::seconds(120);
constexpr Duration ending_patience = std::chrono::seconds(30);

struct NewSessionFlags {
    SessionFlags session;
    std::string name, state;
    bool json = false;
};

fs::path state_of(const NewSessionFlags& flags) {
    return flags.state.empty() ? host::default_state_folder() : fs::path(flags.state);
}

std::optional<ToldSession> told(const fs::path& state, const std::string& name) {
    for (const ToldSession& session : host::told_sessions(state))
        if (session.name == name)
            return session;
    return std::nullopt;
}

// True once `is_done` is, false after `patience`.
template <class Condition>
bool wait_for(Duration patience, const Condition& is_done) {
    const TimePoint end = steady_now() + patience;
    while (!is_done()) {
        if (steady_now() > end)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
}

void print_created(const NewSessionFlags& flags, const fs::path& state, bool is_open) {
    const fs::path folder = host::session_folder(state, flags.name);
    if (!is_open) {
        if (flags.json)
            std::cout << files::json_text({{"name", flags.name}, {"state", "closed"}}) << "\n";
        else
            std::cout << "Session '" << flags.name << "' opens when the host runs.\n";
        return;
    }
    nlohmann::json links;
    const net::Link address = host::read_address(state);
    for (const host::KnownLink& known : host::load_links(folder).links)
        if (wire::parse_role(known.name))
            links[known.name] = host::link_text(known, address);
    if (flags.json) {
        std::cout << files::json_text({{"name", flags.name}, {"state", "open"}, {"links", links}})
                  << "\n";
        return;
    }
    std::cout << "Session '" << flags.name << "' is open. Its links:\n\n";
    for (const auto& [role, link] : links.items())
        std::cout << "  " << role << ":\n\n  " << link.get<std::string>() << "\n\n";
    std::cout << "More links: theatron link --session '" << flags.name << "' --help\n";
}

void create(const NewSessionFlags& flags) {
    host::check_session_name(flags.name);
    const fs::path state = state_of(flags);
    (void)session_options(flags.session);
    host::create_session(state, flags.name, words_of(flags.session, fs::current_path()));
    if (!host::is_host_running(state))
        return print_created(flags, state, false);

    std::optional<ToldSession> now;
    const bool is_answered = wait_for(new_session_patience, [&] {
        now = told(state, flags.name);
        return now && now->state != ToldSession::State::opening;
    });
    if (is_answered && now->state == ToldSession::State::open)
        return print_created(flags, state, true);
    host::ask_for_end(state, flags.name);
    // Its name is free when this returns; a camera that is still being opened may take long.
    if (is_answered)
        (void)wait_for(ending_patience, [&] {
            return !fs::exists(host::session_folder(state, flags.name)) && !told(state, flags.name);
        });
    throw Error("The session was not created. " +
                (is_answered ? now->problem : "The host did not open it in time."));
}

// Without a host, which would write the audit log.
void delete_session(const fs::path& state, const std::string& name) {
    const bool was_open = host::has_links(host::session_folder(state, name));
    host::forget_session(state, name);
    if (was_open && fs::exists(host::usual_audit_log(state)))
        host::AuditLog(host::usual_audit_log(state)).add(host::deletion_of(name), "", name);
}

void end(const NewSessionFlags& flags) {
    const fs::path state = state_of(flags);
    const fs::path folder = host::find_session_folder(state, flags.name);
    if (folder == state)
        throw Error("'" + flags.name +
                    "' is the first session of the host and ends with it; the line 'end session' "
                    "at the host sends everybody away.");
    host::ask_for_end(state, flags.name);
    if (!host::is_host_running(state))
        delete_session(state, flags.name);
    else if (!wait_for(ending_patience, [&] { return !fs::exists(folder); }))
        throw Error("The host has not ended the session in time; it does so when it can.");
    if (flags.json)
        std::cout << files::json_text({{"ended", flags.name}}) << "\n";
    else
        std::fprintf(stderr, "Session '%s' has ended; its links admit nobody any more.\n",
                     flags.name.c_str());
}

void list(const NewSessionFlags& flags) {
    const fs::path state = state_of(flags);
    std::vector<ToldSession> running = host::told_sessions(state);
    nlohmann::json all = nlohmann::json::array();
    for (const ToldSession& session : running)
        all.push_back({{"name", session.name},
                       {"state", text_of(session.state)},
                       {"problem", session.problem}});
    for (const host::KeptSession& kept : host::kept_sessions(state))
        if (std::ranges::find(running, kept.name, &ToldSession::name) == running.end())
            all.push_back({{"name", kept.name}, {"state", "closed"}, {"problem", kept.problem}});
    if (flags.json) {
        std::cout << files::json_text(all) << "\n";
        return;
    }
    if (all.empty())
        std::cout << "No host runs with this state folder, and it keeps no further sessions.\n";
    for (const auto& session : all)
        std::cout << session["name"].get<std::string>() << ": "
                  << session["state"].get<std::string>()
                  << (session["problem"] == "" ? "" : ". " + session["problem"].get<std::string>())
                  << "\n";
}

}  // namespace

void add_session_command(CLI::App& app) {
    const auto flags = std::make_shared<NewSessionFlags>();
    CLI::App* command =
        app.add_subcommand("session", "Create, end and list the sessions of this machine's host");
    command->footer(
        "One host has several sessions, each with its own cameras, people, links and room. Those\n"
        "that are created here open again with the host, until they are ended.\n"
        "\nExamples:\n"
        "  theatron session create 'OR 4' --camera k4a:1\n"
        "  theatron link --session 'OR 4' --role observer\n"
        "  theatron session list\n"
        "  theatron session end 'OR 4'");
    command->require_subcommand(1);
    const auto add = [&](const char* word, const char* help, bool has_name) {
        CLI::App* sub = command->add_subcommand(word, help);
        if (has_name)
            sub->add_option("name", flags->name, "The session's name")->required();
        sub->add_option("--state", flags->state,
                        "The host's state folder (default: ~/.local/state/theatron)");
        sub->add_flag("--json", flags->json, "Print one JSON line");
        return sub;
    };
    CLI::App* created =
        add("create", "Open a further session, which a running host does at once", true);
    add_session_options(*created, flags->session);
    created->callback([flags] { create(*flags); });
    add("end", "End a session for good: its people leave, and its links and its room are deleted",
        true)
        ->callback([flags] { end(*flags); });
    add("list", "List the sessions", false)->callback([flags] { list(*flags); });
}

}  // namespace theatron::app
