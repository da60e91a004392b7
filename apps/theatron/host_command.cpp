// SPDX-License-Identifier: Apache-2.0
// theatron host
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <thread>

#include "base/camera_names.h"
#include "base/error.h"
#include "base/log.h"
#include "base/log_scope.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "camera_lines.h"
#include "capture/camera.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "host/host.h"
#include "host/host_identity.h"
#include "host/page.h"
#include "host_sessions.h"
#include "input_lines.h"
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

struct Flags {
    SessionFlags first;
    host::PortOptions port;
    std::string listen = "0.0.0.0:4400";
    std::string state;
    std::string token_file;
    std::string summary;
    std::string audit;
    std::string certificate, key, proxy_certificate;
    double seconds = 0;
    bool json = false;
    bool prints_links = false;
    // The words of each further session.
    std::vector<std::vector<std::string>> further;
};

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
std::string links_text(const host::Host& host) {
    std::string text = "Join with this link:\n\n  " + host.link() +
                       "\n\nin a browser, or with: theatron join '" + host.link() +
                       "'\n\nWith these\n";
    for (const auto& [role, may] : others)
        text += std::string("  ") + may + ":\n\n  " + host.link(role) + "\n\n";
    return text;
}

std::string all_links_text(const HostSessions& sessions) {
    const auto open = sessions.open();
    std::string text;
    for (const auto& [name, host] : open)
        text += (open.size() > 1 ? "Session '" + name + "'\n\n" : "") + links_text(*host);
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

host::HostOptions options_of(const Flags& flags) {
    host::HostOptions options{session_options(flags.first), flags.port};
    options.listen = net::parse_endpoint(flags.listen);
    options.state = flags.state;
    options.certificate = flags.certificate;
    options.key = flags.key;
    options.proxy_certificate = flags.proxy_certificate;
    options.page = host::usual_page_folder();
    options.is_audited = flags.audit != "none";
    if (options.is_audited)
        options.audit = flags.audit;
    if (!flags.token_file.empty())
        options.token = host::read_token(flags.token_file);
    return options;
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

void run(Flags& flags) {
    const host::HostOptions options = options_of(flags);
    std::vector<SessionFlags> further;
    for (const auto& words : flags.further)
        further.push_back(parse_session(words));
    if (!flags.summary.empty()) {
        files::require_writable(flags.summary);
        files::require_own_kind(flags.summary, "{", "a summary");
    }
    cli::catch_stop_signals();
    // The last changes of the room are written.
    const cli::Saving saving(room_patience);
    auto opening = std::make_optional<cli::Saving>(opening_patience);
    HostSessions sessions(options, flags.first, further);
    opening.reset();

    if (flags.json) {
        output::result(files::json_text(greeting(sessions)) + "\n");
    } else {
        const bool shows_links = flags.prints_links || isatty(STDOUT_FILENO);
        output::print(
            (shows_links ? all_links_text(sessions) : address_text(sessions.first(), flags.state)) +
            "Links for one person, with an end, and as QR codes: theatron link --help\n" +
            (options.cameras.empty() && further.empty()
                 ? "No camera is streamed (--camera): people meet in an empty room.\n"
                 : "") +
            "Ctrl-C ends the session.\n");
    }
    for (const auto& [name, host] : sessions.open())
        say_unregistered(host->unregistered_cameras(), host->camera_names().size());

    InputLines input;
    const bool live_line = !flags.json && isatty(STDOUT_FILENO);
    const TimePoint begin = steady_now();
    TimePoint next_line = begin;
    while (!cli::stop_requested() &&
           (flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds))) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        obey(sessions, input);
        sessions.follow();
        if (live_line && steady_now() >= next_line) {
            output::status_line(status_line(sessions));
            next_line = steady_now() + 500ms;
        }
    }
    cli::begin_end();
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

void add_host_command(CLI::App& app, std::vector<std::vector<std::string>> further) {
    const auto flags = std::make_shared<Flags>();
    flags->further = std::move(further);
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
        "  mute NAME, unmute NAME, role NAME ROLE, remove NAME, revoke NAME\n"
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
    add_session_options(*command, flags->first);
    command->add_option("--listen", flags->listen, "ADDRESS:PORT; port 0 lets the system choose")
        ->capture_default_str();
    auto* certificate = command->add_option(
        "--certificate", flags->certificate,
        "Your organisation's certificate as a PEM file, with those of its issuers, so that "
        "browsers do not warn (docs/hospital_it.md); by default the host makes one itself. It is "
        "read again when it changes");
    auto* key =
        command->add_option("--key", flags->key, "Its key, a PEM file that only you may read");
    certificate->needs(key);
    key->needs(certificate);
    command->add_flag("--hsts", flags->port.insists_on_https,
                      "With --certificate: browsers use only HTTPS for this name for a year "
                      "(Strict-Transport-Security)");
    command
        ->add_option("--public-name", flags->port.public_name,
                     "NAME or NAME:PORT under which participants reach this host: part of the "
                     "links; requests for other names are refused")
        ->check([](const std::string& text) -> std::string {
            return text.empty() ? "it is empty; say NAME or NAME:PORT, or leave it out" : "";
        });
    command
        ->add_option("--behind-proxy", flags->port.proxies,
                     "ADDRESS or NETWORK/BITS of a proxy (nginx, Caddy) whose X-Forwarded-For is "
                     "believed; repeat for more. Needs --public-name and --proxy-certificate")
        ->allow_extra_args(false);
    command->add_option("--proxy-certificate", flags->proxy_certificate,
                        "The proxy's certificate as a PEM file, for the links; read again when it "
                        "changes");
    command
        ->add_option(
            "--session,--name", flags->first.options.name,
            "The session's name, which participants see. A second --session begins "
            "another session of this host, with the options of a session behind it: "
            "--camera, --places, --region, --cases, --identifiers-for, --filter, --direct, "
            "--link-hours, --admit and --look-back")
        ->capture_default_str();
    command->add_option(
        "--link-host", flags->port.link_host,
        "Name or address written into the link, if participants reach this host under another");
    CLI::Option* token = command->add_option(
        "--token", flags->first.options.token,
        "The join token, at least 16 characters; by default one is made at first start and kept");
    command
        ->add_option("--token-file", flags->token_file,
                     "The same from a file that only you may read, or /dev/stdin")
        ->excludes(token);
    command->add_option("--audit", flags->audit,
                        "File for the log of people, JSON lines; none: no log (default: "
                        "audit.jsonl in the state folder)");
    command->add_option(
        "--state", flags->state,
        "Folder for the host's key, certificate and tokens (default: ~/.local/state/theatron)");
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    command->add_option("--summary", flags->summary,
                        "Write what went on as JSON to this file at the end");
    command->add_flag("--print-links", flags->prints_links,
                      "Print the links also where the output is no terminal, but a file or the "
                      "journal of a service, where others may read them");
    command->add_flag("--json", flags->json, "Print one JSON line with the link instead of text");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
