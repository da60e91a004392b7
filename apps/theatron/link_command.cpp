// SPDX-License-Identifier: Apache-2.0
// theatron link
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "cli/choice_check.h"
#include "cli/number_check.h"
#include "commands.h"
#include "files/json_text.h"
#include "host/host_identity.h"
#include "host/link_book.h"
#include "host/session_folder.h"
#include "qr_text.h"

namespace theatron::app {
namespace {

// A host looks at its links twenty times a second.
constexpr Duration answer_patience = std::chrono::seconds(10);

struct LinkFlags {
    std::string role = "expert", label, show, revoke, state, session;
    double hours = 0;
    bool list = false, qr = false, json = false;
};

// 'theatron link' with these options, for the same folder and session.
std::string command_of(const LinkFlags& flags, const std::string& options) {
    return "theatron link " + options +
           (flags.session.empty() ? "" : " --session '" + flags.session + "'") +
           (flags.state.empty() ? "" : " --state '" + flags.state + "'");
}

nlohmann::json facts_of(const host::KnownLink& link) {
    return {{"name", link.name},
            {"role", wire::text_of(link.role)},
            {"until", link.expires ? files::utc_text(*link.expires) : ""},
            {"expired", link.has_expired(files::utc_now())},
            {"for", link.label}};
}

void print(const host::KnownLink& link, const net::Link& address, const LinkFlags& flags) {
    const std::string text = host::link_text(link, address);
    if (flags.json) {
        nlohmann::json json = facts_of(link);
        json["link"] = text;
        std::cout << files::json_text(json) << "\n";
        return;
    }
    std::cout << text << "\n";
    if (flags.qr)
        std::cout << "\n" << qr_text(text, isatty(STDOUT_FILENO));
    // Not on standard output, which may be a file for 'theatron join @FILE'.
    std::fprintf(stderr, "Link %s: %s%s%s. This ends it at once:\n  %s\n", link.name.c_str(),
                 wire::text_of(link.role),
                 link.label.empty() ? "" : (", for " + link.label).c_str(),
                 link.expires ? (", until " + files::utc_text(*link.expires)).c_str() : "",
                 command_of(flags, "--revoke " + link.name).c_str());
}

void print_list(const std::vector<host::KnownLink>& links, bool json) {
    if (json) {
        nlohmann::json all = nlohmann::json::array();
        for (const host::KnownLink& link : links)
            all.push_back(facts_of(link));
        std::cout << files::json_text(all) << "\n";
        return;
    }
    std::printf("%-10s %-10s %-26s %s\n", "link", "role", "until", "for");
    for (const host::KnownLink& link : links) {
        const std::string until = !link.expires ? "no end"
                                  : link.has_expired(files::utc_now())
                                      ? "expired"
                                      : files::utc_text(*link.expires);
        std::printf("%-10s %-10s %-26s %s\n", link.name.c_str(), wire::text_of(link.role),
                    until.c_str(), link.label.c_str());
    }
}

// True if the host admits by the links as they are now, or none runs that could admit anybody. A
// session that is not open reads them when it opens.
bool is_followed(const std::filesystem::path& state, const std::filesystem::path& folder,
                 const std::string& session) {
    if (!host::is_host_running(state) || host::are_links_followed(folder))
        return true;
    if (folder == state)
        return false;
    const auto told = host::told_sessions(state);
    return std::ranges::none_of(told, [&](const host::ToldSession& there) {
        return there.name == session && there.state == host::ToldSession::State::open;
    });
}

void revoke(const LinkFlags& flags, const std::filesystem::path& state,
            const std::filesystem::path& folder) {
    bool was_there = false;
    try {
        was_there = host::revoke_link(folder, flags.revoke);
    } catch (const Error& error) {
        throw Error("Link " + flags.revoke +
                    " is not revoked, and still admits people: " + error.what() +
                    " Mend that and say it again; an operator in the room can remove people at "
                    "once.");
    }
    if (!was_there)
        throw Error("There is no link '" + flags.revoke + "'. This lists them:\n  " +
                    command_of(flags, "--list"));
    const TimePoint end = steady_now() + answer_patience;
    while (!is_followed(state, folder, flags.session)) {
        if (steady_now() > end)
            throw Error("Link " + flags.revoke +
                        " is revoked, but the host that runs has not said that it follows, and may "
                        "still admit by it. See its log; if it hangs, end it.");
        std::this_thread::sleep_for(50ms);
    }
    if (flags.json)
        std::cout << files::json_text({{"revoked", flags.revoke}}) << "\n";
    else
        std::fprintf(stderr, "Link %s admits nobody any more.%s\n", flags.revoke.c_str(),
                     wire::parse_role(flags.revoke) ? (" There is a new one; this prints it:\n  " +
                                                       command_of(flags, "--show " + flags.revoke))
                                                          .c_str()
                                                    : "");
}

void run(const LinkFlags& flags) {
    const std::filesystem::path state =
        flags.state.empty() ? host::default_state_folder() : std::filesystem::path(flags.state);
    const net::Link address = host::read_address(state);
    const std::filesystem::path folder =
        flags.session.empty() ? state : host::find_session_folder(state, flags.session);
    if (!flags.revoke.empty())
        return revoke(flags, state, folder);
    const host::KnownLinks book = host::load_links(folder);
    for (const std::string& problem : book.problems)
        std::fprintf(stderr, "A link admits nobody. %s\n", problem.c_str());
    if (flags.list)
        return print_list(book.links, flags.json);
    if (!flags.show.empty()) {
        for (const host::KnownLink& link : book.links)
            if (link.name == flags.show)
                return print(link, address, flags);
        throw Error("There is no link '" + flags.show + "'. This lists them:\n  " +
                    command_of(flags, "--list"));
    }
    std::optional<files::UtcSeconds> expires;
    if (flags.hours > 0)
        expires = files::utc_now() + files::UtcSeconds(std::llround(flags.hours * 3600));
    print(host::make_link(folder, *wire::parse_link_role(flags.role), expires, flags.label),
          address, flags);
}

}  // namespace

void add_link_command(CLI::App& app) {
    const auto flags = std::make_shared<LinkFlags>();
    CLI::App* command =
        app.add_subcommand("link", "Make a link of this machine's host for somebody, or revoke it");
    command->footer(
        "A running host follows at once; who came by a revoked link is removed. --revoke waits "
        "for\n"
        "that, and fails if the host does not say so.\n"
        "\nExamples:\n"
        "  theatron link --role expert --hours 2 --for 'Dr. Ada' --qr\n"
        "  theatron link --list\n"
        "  theatron link --show observer --qr\n"
        "  theatron link --revoke 5f0c2a91\n"
        "  theatron link --session 'OR 4' --show expert");
    CLI::Option* role =
        command
            ->add_option("--role", flags->role,
                         "operator, expert, observer or publisher; relay: for "
                         "'theatron relay'")
            ->capture_default_str()
            ->check(cli::one_of({"operator", "expert", "observer", "publisher", "relay"}));
    CLI::Option* hours =
        command
            ->add_option(
                "--hours", flags->hours,
                "After this number of hours it lets nobody in; those who are in stay. Without "
                "it: until it is revoked")
            ->check(cli::number_check([](double value) { return value > 0 && value <= 10'000; },
                                      "is not a number of hours greater than 0 and up to 10000"));
    CLI::Option* label = command->add_option("--for", flags->label, "For whom it is, for --list");
    CLI::Option* list = command->add_flag("--list", flags->list, "List all links");
    CLI::Option* show = command->add_option("--show", flags->show,
                                            "Print the link of this name, or of a role, again");
    CLI::Option* revoke = command->add_option(
        "--revoke", flags->revoke,
        "Make the link of this name invalid; that of a role gets another token");
    for (CLI::Option* other : {list, show, revoke})
        for (CLI::Option* made : {role, hours, label})
            other->excludes(made);
    list->excludes(show)->excludes(revoke);
    show->excludes(revoke);
    command->add_option("--session", flags->session,
                        "The session of the host; without it the first one ('theatron session "
                        "list' names them)");
    command->add_flag("--qr", flags->qr, "Print it as a QR code, too");
    command->add_flag("--json", flags->json, "Print one JSON line");
    command->add_option("--state", flags->state,
                        "The host's state folder (default: ~/.local/state/theatron)");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
