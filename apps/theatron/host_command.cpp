// SPDX-License-Identifier: Apache-2.0
// theatron host
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "camera_option.h"
#include "capture/camera.h"
#include "commands.h"
#include "host.h"
#include "progress.h"
#include "stop_signal.h"

namespace theatron::app {
namespace {

struct Flags {
    HostOptions options;
    std::string listen = "0.0.0.0:4400";
    std::string state;
    std::string summary;
    double seconds = 0;
    bool json = false;
};

void run(Flags& flags) {
    flags.options.listen = net::parse_endpoint(flags.listen);
    flags.options.state = flags.state;
    catch_stop_signals();
    Host host(flags.options, show_progress());

    if (flags.json) {
        std::cout << nlohmann::json{{"link", host.link()},
                                    {"port", host.port()},
                                    {"cameras", host.camera_names()}}
                         .dump()
                  << std::endl;
    } else {
        std::cout << "Join with this link:\n\n  " << host.link() << "\n\n"
                  << "for example: theatron join '" << host.link() << "'\n"
                  << "Ctrl-C ends the session.\n"
                  << std::flush;
    }

    const bool live_line = !flags.json && isatty(STDOUT_FILENO);
    const TimePoint begin = steady_now();
    TimePoint next_line = begin;
    while (!stop_requested() &&
           (flags.seconds <= 0 || steady_now() - begin < seconds_to_duration(flags.seconds))) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (live_line && steady_now() >= next_line) {
            std::cout << "\r\033[K" << host.status_line() << std::flush;
            next_line = steady_now() + 500ms;
        }
    }
    if (live_line)
        std::cout << "\n";
    if (!flags.summary.empty()) {
        std::ofstream out(flags.summary);
        out << host.figures().dump(2) << "\n";
        if (!out.flush())
            throw Error("Cannot write the summary to " + flags.summary + ".");
    }
}

}  // namespace

void add_host_command(CLI::App& app) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("host", "Stream cameras to those who join");
    std::string cameras = "The kinds of camera:\n";
    for (const std::string& kind : capture::camera_kinds())
        cameras += "  " + kind + "\n";
    command->footer(cameras +
                    "\nExamples:\n"
                    "  theatron host --camera folder:recordings/table,loop=1\n"
                    "  theatron host --camera mkv:left.mkv,loop=1 --camera mkv:right.mkv,loop=1 "
                    "--listen 0.0.0.0:4400 --name 'OR 3'");
    add_camera_option(*command, flags->options.cameras)->required();
    command->add_option("--listen", flags->listen, "ADDRESS:PORT; port 0 lets the system choose")
        ->capture_default_str();
    command->add_option("--name", flags->options.name, "What participants see as the room's name")
        ->capture_default_str();
    command->add_option(
        "--link-host", flags->options.link_host,
        "Name or address written into the link, if participants reach this host under another");
    command->add_option("--token", flags->options.token,
                        "The join token; by default one is made at first start and kept");
    command->add_option(
        "--state", flags->state,
        "Folder for the host's key, certificate and token (default: ~/.local/state/theatron)");
    command->add_option("--seconds", flags->seconds, "End by itself after this time");
    command->add_option("--summary", flags->summary,
                        "Write what went on as JSON to this file at the end");
    command->add_flag("--json", flags->json, "Print one JSON line with the link instead of text");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
