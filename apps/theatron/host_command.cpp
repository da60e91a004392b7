// SPDX-License-Identifier: Apache-2.0
// theatron host
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/camera_names.h"
#include "base/error.h"
#include "base/outside_text.h"
#include "base/steady_clock.h"
#include "camera_lines.h"
#include "capture/camera.h"
#include "cli/camera_option.h"
#include "cli/progress.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "host/host.h"
#include "host/host_identity.h"
#include "host/page.h"
#include "input_lines.h"
#include "people_lines.h"
#include "playback_lines.h"
#include "region_text.h"
#include "session/permissions.h"
#include "viewer/renderer_text.h"

namespace theatron::app {
namespace {

// The roles whose links are printed after that of experts.
constexpr std::pair<wire::Role, const char*> others[] = {
    {wire::Role::operator_, "operators admit, mute and remove others, and change their roles"},
    {wire::Role::observer, "observers only see"},
    {wire::Role::publisher, "participants can send cameras, too"}};

struct Flags {
    host::HostOptions options;
    std::vector<std::string> regions;
    std::string listen = "0.0.0.0:4400";
    std::string state;
    std::string token_file;
    std::string summary;
    std::string places;
    std::string audit, admit = "all";
    std::string cases, identifiers_for = "operator";
    std::string certificate, key, proxy_certificate;
    double seconds = 0;
    double link_hours = 0;
    std::string direct = "on";
    double look_back_s = to_seconds(session::Past::longest_reach);
    bool json = false;
    bool prints_links = false;
};

// All parts that are given for a camera make its region.
void draw_regions(host::Host& host, const std::vector<std::string>& texts) {
    std::map<std::size_t, codec::strata::Region> regions;
    for (const std::string& text : texts) {
        RegionText part = parse_region(text);
        regions[find_camera(part.camera, host.camera_names())].push_back(std::move(part.polygon));
    }
    for (auto& [camera, region] : regions)
        host.set_region(camera, std::move(region));
}

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

void obey(host::Host& host, InputLines& input) {
    while (const auto line = input.next()) {
        try {
            obey(host, *line);
        } catch (const Error& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
    }
}

// A link lets its bearer in, so it goes only to a terminal or where it was asked for: a service's
// output is kept in a journal that others read.
void print_links(const host::Host& host) {
    std::cout << "Join with this link:\n\n  " << host.link() << "\n\n"
              << "in a browser, or with: theatron join '" << host.link() << "'\n\n"
              << "With these\n";
    for (const auto& [role, may] : others)
        std::cout << "  " << may << ":\n\n  " << host.link(role) << "\n\n";
}

void print_address(const host::Host& host, const std::string& state) {
    const std::string link = host.link(), in_state = state.empty() ? "" : " --state " + state;
    std::cout << "Listening at " << link.substr(0, link.find('#')) << "\n"
              << "This is no terminal, and others may read it, so the links that let people in are "
                 "not printed here.\n'theatron link --show expert"
              << in_state << "' prints one, and --print-links prints them here.\n";
}

// The picture of a single camera is right without a registration.
void say_unregistered(const std::vector<std::string>& unregistered, std::size_t cameras) {
    if (unregistered.empty() || cameras < 2)
        return;
    std::string names;
    for (const std::string& name : unregistered)
        names += (names.empty() ? "" : ", ") + name;
    std::fprintf(stderr,
                 "Nobody knows where these cameras are in the room: %s. They are shown 12 m apart. "
                 "'theatron register' finds their places for --places; place=X:Y:Z gives one by "
                 "hand.\n",
                 names.c_str());
}

// "operator,expert", or "nobody".
std::vector<wire::Role> parse_patient_roles(const std::string& text) {
    std::vector<wire::Role> roles;
    if (text == "nobody")
        return roles;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) {
        const auto role = wire::parse_role(word);
        if (!role || !session::may_know_patient(*role))
            throw Error("'" + clean_text(word, 40) +
                        "' in --identifiers-for is none of operator, expert and publisher" +
                        (role ? ": observers never learn who the patient is." : ", or nobody."));
        roles.push_back(*role);
    }
    return roles;
}

void run(Flags& flags) {
    flags.options.listen = net::parse_endpoint(flags.listen);
    flags.options.state = flags.state;
    flags.options.places = flags.places;
    flags.options.cases = flags.cases;
    flags.options.patient_for = parse_patient_roles(flags.identifiers_for);
    flags.options.certificate = flags.certificate;
    flags.options.key = flags.key;
    flags.options.proxy_certificate = flags.proxy_certificate;
    flags.options.page = host::usual_page_folder();
    flags.options.is_audited = flags.audit != "none";
    if (flags.options.is_audited)
        flags.options.audit = flags.audit;
    flags.options.asks = flags.admit == "ask";
    flags.options.link_lifetime = seconds_to_duration(flags.link_hours * 3600);
    flags.options.direct = flags.direct == "on";
    flags.options.look_back = seconds_to_duration(flags.look_back_s);
    if (!flags.token_file.empty())
        flags.options.token = host::read_token(flags.token_file);
    if (!flags.summary.empty()) {
        files::require_writable(flags.summary);
        files::require_own_kind(flags.summary, "{", "a summary");
    }
    cli::catch_stop_signals();
    host::Host host(flags.options, cli::show_progress());
    draw_regions(host, flags.regions);

    if (flags.json) {
        nlohmann::json links;
        for (const wire::Role role : wire::roles)
            links[wire::text_of(role)] = host.link(role);
        std::cout << files::json_text({{"link", host.link()},
                                       {"publish_link", host.link(wire::Role::publisher)},
                                       {"links", links},
                                       {"port", host.port()},
                                       {"cameras", host.camera_names()}})
                  << std::endl;
    } else {
        if (flags.prints_links || isatty(STDOUT_FILENO))
            print_links(host);
        else
            print_address(host, flags.state);
        std::cout << "Links for one person, with an end, and as QR codes: theatron link --help\n"
                  << (flags.options.cameras.empty()
                          ? "No camera is streamed (--camera): people meet in an empty room.\n"
                          : "")
                  << "Ctrl-C ends the session.\n"
                  << std::flush;
    }
    say_unregistered(host.unregistered_cameras(), host.camera_names().size());

    InputLines input;
    const bool live_line = !flags.json && isatty(STDOUT_FILENO);
    const TimePoint begin = steady_now();
    TimePoint next_line = begin, next_look = begin;
    while (!cli::stop_requested() &&
           (flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds))) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        obey(host, input);
        host.follow_links();
        if (steady_now() >= next_look) {
            host.follow_filter_files();
            host.follow_certificates();
            next_look = steady_now() + 500ms;
        }
        if (live_line && steady_now() >= next_line) {
            std::cout << "\r\033[K" << host.status_line() << std::flush;
            next_line = steady_now() + 500ms;
        }
    }
    if (live_line)
        std::cout << "\n";
    const std::string room_problem = host.room_problem();
    if (!flags.summary.empty()) {
        std::ofstream out(flags.summary);
        out << files::json_text(host::to_json(host.figures()), 2) << "\n";
        if (!out.flush())
            throw Error("Cannot write the summary to " + flags.summary + ".");
    }
    if (!room_problem.empty())
        throw Error("The room could not be saved and ends with this session. " + room_problem);
}

}  // namespace

void add_host_command(CLI::App& app) {
    const auto flags = std::make_shared<Flags>();
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
        "  nudge 0 10 0 -5 0 1.5 0        moves camera 0 by 10 mm along x and -5 along z, turns\n"
        "                                 it by 1.5 degrees about y, from where it is registered,\n"
        "                                 for all; 'nudge 0 none'\n"
        "  pause, play, seek 60, seek +5  the recording of recording:FILE, for all\n"
        "\nExamples:\n"
        "  theatron host --camera folder:recordings/table,loop=1\n"
        "  theatron host --camera mkv:left.mkv,loop=1 --camera mkv:right.mkv,loop=1 "
        "--listen 0.0.0.0:4400 --name 'OR 3'\n"
        "  theatron host --camera k4a:0 --region 0=200:150:240:180");
    cli::add_camera_option(*command, flags->options.cameras);
    command->add_option("--places", flags->places,
                        "Where the cameras are in the room: a file that 'theatron register' wrote. "
                        "A camera's own place=X:Y:Z:YAW:PITCH:ROLL is the last word");
    command
        ->add_option("--region", flags->regions,
                     "CAMERA=X:Y:WIDTH:HEIGHT, the part of a camera's depth image that stays exact "
                     "when a slow link makes the rest coarser; a polygon is CAMERA=X:Y:X:Y:X:Y. "
                     "CAMERA is a number from 0 or a name. Repeat for more parts. Without a region "
                     "the whole image stays exact")
        ->allow_extra_args(false);
    command->add_option("--cases", flags->cases,
                        "A folder of cases (docs/cases.md): each case that lies there, or is put "
                        "there later, can be opened in the room");
    command
        ->add_option("--identifiers-for", flags->identifiers_for,
                     "The roles that see the name, date of birth and number of the open case's "
                     "patient: operator, expert and publisher, with commas, or nobody")
        ->capture_default_str();
    command
        ->add_option(
            "--filter", flags->options.filters,
            "Filters of depth: off, paper, default, a line of filters or a JSON file, which "
            "may change meanwhile; CAMERA=... for one camera, by number from 0 or name")
        ->allow_extra_args(false);
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
    command->add_flag("--hsts", flags->options.insists_on_https,
                      "With --certificate: browsers use only HTTPS for this name for a year "
                      "(Strict-Transport-Security)");
    command
        ->add_option("--public-name", flags->options.public_name,
                     "NAME or NAME:PORT under which participants reach this host: part of the "
                     "links; requests for other names are refused")
        ->check([](const std::string& text) -> std::string {
            return text.empty() ? "it is empty; say NAME or NAME:PORT, or leave it out" : "";
        });
    command
        ->add_option("--behind-proxy", flags->options.proxies,
                     "ADDRESS or NETWORK/BITS of a proxy (nginx, Caddy) whose X-Forwarded-For is "
                     "believed; repeat for more. Needs --public-name and --proxy-certificate")
        ->allow_extra_args(false);
    command->add_option("--proxy-certificate", flags->proxy_certificate,
                        "The proxy's certificate as a PEM file, for the links; read again when it "
                        "changes");
    command->add_option("--name", flags->options.name, "What participants see as the room's name")
        ->capture_default_str();
    command->add_option(
        "--link-host", flags->options.link_host,
        "Name or address written into the link, if participants reach this host under another");
    CLI::Option* token = command->add_option(
        "--token", flags->options.token,
        "The join token, at least 16 characters; by default one is made at first start and kept");
    command
        ->add_option("--token-file", flags->token_file,
                     "The same from a file that only you may read, or /dev/stdin")
        ->excludes(token);
    command
        ->add_option("--link-hours", flags->link_hours,
                     "The links let nobody in after so many hours; participants who are in stay. "
                     "0: they always do")
        ->check([](const std::string& text) -> std::string {
            double value = 0;
            // A comparison with nan is false.
            if (CLI::detail::lexical_cast(text, value) && value >= 0 && value <= 1000)
                return "";
            return "'" + text + "' is not a number of hours from 0 to 1000";
        });
    command
        ->add_option("--admit", flags->admit,
                     "all: everyone with a valid link is let in; ask: experts and observers wait "
                     "until an operator admits them")
        ->capture_default_str()
        ->check(CLI::IsMember({"all", "ask"}));
    command
        ->add_option("--look-back", flags->look_back_s,
                     "How many seconds participants may look back at the cameras of the room, 0 to "
                     "60; they are kept in memory only, 512 MiB at most. 0: nothing is kept")
        ->capture_default_str()
        ->check([](const std::string& text) -> std::string {
            double seconds = -1;
            // A range check of CLI11 takes "nan".
            const bool is_number = CLI::detail::lexical_cast(text, seconds);
            if (is_number && seconds >= 0 && seconds <= to_seconds(session::Past::longest_reach))
                return "";
            return "'" + text + "' is not a number of seconds from 0 to 60";
        });
    command
        ->add_option("--direct", flags->direct,
                     "on: pictures of a participant's cameras go from it to those who can reach "
                     "it; off: all pictures go through this host")
        ->capture_default_str()
        ->check(CLI::IsMember({"on", "off"}));
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
