// SPDX-License-Identifier: Apache-2.0
// theatron host
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "base/camera_names.h"
#include "base/error.h"
#include "base/log.h"
#include "base/log_format.h"
#include "base/log_scope.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "camera_lines.h"
#include "capture/camera.h"
#include "cli/reload_signal.h"
#include "cli/service_notice.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "host/host.h"
#include "host/host_identity.h"
#include "host/kept_certificate.h"
#include "host/page.h"
#include "host_config.h"
#include "host_flags.h"
#include "host_sessions.h"
#include "input_lines.h"
#include "net/http.h"
#include "people_lines.h"
#include "playback_lines.h"
#include "region_text.h"
#include "session_flags.h"
#include "viewer/renderer_text.h"

namespace theatron::app {
namespace {

constexpr Duration room_patience = std::chrono::seconds(5);
// A room that is being generated is taken away again.
constexpr Duration opening_patience = std::chrono::seconds(60);

// The roles whose links are printed after that of experts.
constexpr std::pair<wire::Role, const char*> others[] = {
    {wire::Role::operator_, "operators admit, mute and remove others, and change their roles"},
    {wire::Role::observer, "observers only see"},
    {wire::Role::publisher, "participants can send cameras, too"}};

// "CAMERA PART...", "CAMERA none". Throws Error if it cannot be done.
void change_region(host::Host& host, std::istringstream words) {
    std::string camera, part;
    words >> camera;
    codec::strata::Region region;
    bool none = false;
    while (words >> part)
        if (part == "none")
            none = true;
        else
            region.push_back(parse_polygon(part));
    if (none == !region.empty())
        throw Error("Say 'region CAMERA X:Y:WIDTH:HEIGHT...' or 'region CAMERA none'.");
    host.set_region(find_camera(camera, host.camera_names()), std::move(region));
}

// Throws Error if it cannot be done.
void obey(host::Host& host, const std::string& line) {
    if (obey_people_line(host, line) || obey_camera_line(host, line) ||
        obey_playback_line(host, line))
        return;
    std::istringstream words(line);
    std::string what, rest;
    words >> what;
    std::getline(words, rest);
    if (what == "region") {
        change_region(host, std::istringstream(rest));
    } else if (what == "renderer") {
        const viewer::RendererText text = viewer::parse_renderer(rest);
        host.set_renderer(text.who, text.word);
    } else if (!what.empty()) {
        throw Error("There is no command '" + what +
                    "'; lines begin with region or renderer, or are " + people_help() + ", " +
                    camera_lines_help() + ", " + playback_lines_help() + ".");
    }
}

// "in NAME: LINE" is for the session of this name, other lines are for the first one.
void obey(HostSessions& sessions, const std::string& line) {
    const std::string_view prefix = "in ";
    if (!line.starts_with(prefix) || line.find(": ") == std::string::npos)
        return obey(sessions.first(), line);
    // A name may hold ": ", so the longest one that fits is meant.
    std::string name, names;
    host::Host* meant = nullptr;
    for (const auto& [open_name, host] : sessions.open()) {
        if (line.starts_with(std::string(prefix) + open_name + ": ") &&
            (!meant || open_name.size() > name.size())) {
            meant = host;
            name = open_name;
        }
        names += (names.empty() ? "'" : ", '") + open_name + "'";
    }
    if (!meant)
        throw Error("There is no session '" +
                    line.substr(prefix.size(), line.find(": ") - prefix.size()) + "'; there are " +
                    names + ".");
    const log::SessionScope scope(sessions.name_in_log(name));
    obey(*meant, line.substr(prefix.size() + name.size() + 2));
}

void obey(HostSessions& sessions, InputLines& input) {
    for (const std::string& line : input.take()) {
        try {
            obey(sessions, line);
        } catch (const Error& error) {
            log::say(error.what());
        }
    }
}

// A link lets its bearer in, so it goes only to a terminal or where it was asked for: a service's
// output is kept in a journal that others read.
std::string links_text(const host::Host& host, bool has_page) {
    std::string text = "Join with this link:\n\n  " + host.link() + "\n\n" +
                       (has_page ? "in a browser, or with" : "with") + ": theatron join '" +
                       host.link() + "'\n\nWith these\n";
    for (const auto& [role, may] : others)
        text += std::string("  ") + may + ":\n\n  " + host.link(role) + "\n\n";
    return text;
}

// A guest meets a warning before this page, whose certificate no browser knows.
std::string browser_text(const HostFlags& flags, bool has_page) {
    if (!has_page)
        return "This host has no page for browsers, because no page was found.\n\n";
    if (!flags.certificate.empty() || !flags.proxy_certificate.empty())
        return "";
    return "The certificate is this host's own, so a guest's browser says first that the "
           "connection is not private: 'Advanced' and then 'Proceed' (Firefox: 'Accept the Risk "
           "and Continue') leads in. With a certificate of your organisation no browser asks: "
           "theatron certificate --help\n\n";
}

std::string all_links_text(const HostSessions& sessions, bool has_page) {
    const auto open = sessions.open();
    std::string text;
    for (const auto& [name, host] : open)
        text += (open.size() > 1 ? "Session '" + name + "'\n\n" : "") + links_text(*host, has_page);
    return text;
}

std::string address_text(const host::Host& host, const std::string& state) {
    const std::string link = host.link(), in_state = state.empty() ? "" : " --state " + state;
    return "Listening at " + link.substr(0, link.find('#')) +
           "\nThis is no terminal, and others may read it, so the links that let people in are not "
           "printed here.\n'theatron link --show expert" +
           in_state + "' prints one, and --print-links prints them here.\n";
}

// The picture of a single camera is right without a registration.
void say_unregistered(const std::vector<std::string>& unregistered, std::size_t cameras) {
    if (unregistered.empty() || cameras < 2)
        return;
    std::string names;
    for (const std::string& name : unregistered)
        names += (names.empty() ? "" : ", ") + name;
    log::say("Nobody knows where these cameras are in the room: " + names +
             ". They are shown 12 m apart. 'theatron register' finds their places for --places; "
             "place=X:Y:Z gives one by hand.");
}

nlohmann::json links_of(const host::Host& host) {
    nlohmann::json links;
    for (const wire::Role role : wire::roles)
        links[wire::text_of(role)] = host.link(role);
    return links;
}

nlohmann::json greeting(HostSessions& sessions) {
    const host::Host& host = sessions.first();
    nlohmann::json json{{"link", host.link()},
                        {"publish_link", host.link(wire::Role::publisher)},
                        {"links", links_of(host)},
                        {"port", host.port()},
                        {"cameras", host.camera_names()}};
    for (const auto& [name, other] : sessions.open())
        if (other != &host)
            json["sessions"].push_back(
                {{"name", name}, {"links", links_of(*other)}, {"cameras", other->camera_names()}});
    return json;
}

std::string status_line(const HostSessions& sessions) {
    const auto open = sessions.open();
    if (open.size() == 1)
        return open.front().second->status_line();
    std::string line;
    for (const auto& [name, host] : open)
        line += (line.empty() ? "" : "  |  ") + name + ": " + host->status_line();
    return line;
}

// The answer to SIGHUP: all files but the configuration are followed by themselves. `given`: the
// words of the command line, which names it.
void look_at_config(const std::vector<std::string>& given) {
    try {
        (void)with_config(given);
        log::say("The configuration can be used; a change in it holds from the next start.");
    } catch (const Error& error) {
        // A mistake each, since a long sentence is cut.
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);)
            log::say(line);
        log::say("The host goes on as it was started.");
    }
}

// For those who look at the service.
std::string service_status(HostSessions& sessions, std::size_t open) {
    return std::to_string(open) + (open == 1 ? " session" : " sessions") + " open at port " +
           std::to_string(sessions.first().port());
}

// Warnings that a host with these options would give at once, a line each.
std::string certificate_remarks(const host::HostOptions& options) {
    std::string name;
    if (!options.public_name.empty())
        name = net::parse_public_name(options.public_name, 0).name;
    std::string remarks;
    const auto add = [&](const std::filesystem::path& certificate, const std::filesystem::path& key,
                         const std::string& expected) {
        if (certificate.empty())
            return;
        const host::KeptCertificate kept{net::CertificateFiles(certificate, key)};
        if (const std::string problem = kept.problem(files::utc_now(), expected); !problem.empty())
            remarks += problem + "\n";
    };
    const bool is_behind_proxy = !options.proxy_certificate.empty();
    add(options.certificate, options.key, is_behind_proxy ? "" : name);
    add(options.proxy_certificate, "", name);
    return remarks;
}

void run(HostFlags& flags) {
    if (flags.only_checks && flags.config.empty())
        throw Error("--check-config needs --config FILE, which it reads.");
    const host::HostOptions options = host_options(flags);
    std::vector<SessionFlags> further;
    for (const auto& words : flags.further)
        further.push_back(parse_session(words));
    if (flags.only_checks)
        return output::print("The configuration '" + flags.config + "' can be used.\n" +
                             certificate_remarks(options));
    if (!flags.summary.empty()) {
        files::require_writable(flags.summary);
        files::require_own_kind(flags.summary, "{", "a summary");
    }
    log::set_json_lines(flags.logs_json);
    cli::ServiceNotice notice = cli::ServiceNotice::of_environment();
    cli::catch_stop_signals();
    // Elsewhere SIGHUP says that the terminal is gone.
    if (!flags.config.empty() && notice.has_manager())
        cli::catch_reload_signal();
    // The last changes of the room are written.
    const cli::Saving saving(room_patience);
    auto opening = std::make_optional<cli::Saving>(opening_patience);
    HostSessions sessions(options, flags.first, further);
    opening.reset();

    const bool has_page = host::has_page(options.page);
    if (flags.json) {
        output::result(files::json_text(greeting(sessions)) + "\n");
    } else if (flags.logs_json && !flags.prints_links) {
        const std::string link = sessions.first().link();
        log::info("host", "listening", {{"address", link.substr(0, link.find('#'))}});
    } else {
        const bool shows_links = flags.prints_links || isatty(STDOUT_FILENO);
        output::print((shows_links
                           ? all_links_text(sessions, has_page) + browser_text(flags, has_page)
                           : address_text(sessions.first(), flags.state)) +
                      "Links for one person, with an end, and as QR codes: theatron link --help\n" +
                      (options.cameras.empty() && further.empty()
                           ? "No camera is streamed (--camera): people meet in an empty room.\n"
                           : "") +
                      "Ctrl-C ends the session.\n");
    }
    for (const auto& [name, host] : sessions.open())
        say_unregistered(host->unregistered_cameras(), host->camera_names().size());

    std::size_t open = sessions.open().size();
    notice.ready(service_status(sessions, open));
    InputLines input;
    const bool live_line = !flags.json && !flags.logs_json && isatty(STDOUT_FILENO);
    const TimePoint begin = steady_now();
    TimePoint next_line = begin;
    while (!cli::stop_requested() &&
           (flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds))) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        obey(sessions, input);
        sessions.follow();
        if (const std::size_t now_open = sessions.open().size(); now_open != open) {
            open = now_open;
            notice.status(service_status(sessions, open));
        }
        if (cli::take_reload_signal()) {
            notice.reloading(steady_now());
            look_at_config(flags.given);
            notice.ready(service_status(sessions, open));
        }
        notice.alive(steady_now());
        if (live_line && steady_now() >= next_line) {
            output::status_line(status_line(sessions));
            next_line = steady_now() + 500ms;
        }
    }
    cli::begin_end();
    notice.stopping();
    if (cli::stop_requested() && !cli::stopped_by_person())
        for (const auto& [name, host] : sessions.open())
            host->end_for_now();
    output::end_status_line();
    const std::string room_problem = sessions.room_problem();
    if (!flags.summary.empty()) {
        std::ofstream out(flags.summary);
        out << files::json_text(host::to_json(sessions.figures()), 2) << "\n";
        if (!out.flush())
            throw Error("Cannot write the summary to " + flags.summary + ".");
    }
    if (!room_problem.empty())
        throw Error("The room could not be saved and ends with this session. " + room_problem);
}

}  // namespace

void add_host_command(CLI::App& app, std::vector<std::vector<std::string>> further,
                      std::vector<std::string> given) {
    const auto flags = std::make_shared<HostFlags>();
    flags->further = std::move(further);
    flags->given = std::move(given);
    CLI::App* command = app.add_subcommand("host", "Stream cameras to those who join");
    std::string cameras = "The kinds of camera:\n";
    for (const std::string& kind : capture::camera_kinds())
        cameras += "  " + kind + "\n";
    command->footer(
        cameras +
        "\nLines on standard input, at any time:\n"
        "  region 0 100:50:300:200        the region of interest of camera 0; 'region 0 none'\n"
        "  renderer mesh                  how all participants draw, now and when they join;\n"
        "                                 each may choose another afterwards\n"
        "  renderer 2 blend lock          participant 2, who cannot change it; a name instead of\n"
        "                                 the number also holds when they join again\n"
        "  renderer all free              they choose again\n"
        "  admit NAME, refuse NAME        someone who waits, with --admit ask\n"
        "  mute NAME, unmute NAME, lower NAME (a raised hand), role NAME ROLE, remove NAME, revoke "
        "NAME\n"
        "                                 decisions on people, as of an operator; revoke makes\n"
        "                                 the link of that person invalid\n"
        "  end session                    for all\n"
        "  in OR 2: mute NAME             the same in the session 'OR 2'; lines without it are "
        "for\n"
        "                                 the first session\n"
        "  nudge 0 10 0 -5 0 1.5 0        moves camera 0 by 10 mm along x and -5 along z, turns\n"
        "                                 it by 1.5 degrees about y, from where it is registered,\n"
        "                                 for all; 'nudge 0 none'\n"
        "  pause, play, seek 60, seek +5  the recording of recording:FILE, for all\n"
        "\nExamples:\n"
        "  theatron host --camera folder:recordings/table,loop=1\n"
        "  theatron host --camera mkv:left.mkv,loop=1 --camera mkv:right.mkv,loop=1 "
        "--listen 0.0.0.0:4400 --name 'OR 3'\n"
        "  theatron host --session 'OR 3' --camera k4a:0 --session 'OR 4' --camera k4a:1\n"
        "  theatron host --camera k4a:0 --region 0=200:150:240:180");
    add_host_options(*command, *flags);
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
