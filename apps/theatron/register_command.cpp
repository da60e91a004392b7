// SPDX-License-Identifier: Apache-2.0
// theatron register
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/steady_clock.h"
#include "board_option.h"
#include "capture/camera_places.h"
#include "cli/camera_option.h"
#include "cli/progress.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "depth_source.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "link_argument.h"
#include "registration/board_session.h"
#include "registration/room_alignment.h"

namespace theatron::app {
namespace {

using registration::BoardSession;
using registration::RigSolution;

using Cameras = std::vector<DepthSource::Camera>;

struct Flags {
    std::string link;
    std::vector<std::string> cameras;
    BoardFlags board;
    std::string output;
    int poses = 10;
    double seconds = 0;
    bool json = false;
};

std::unique_ptr<DepthSource> open(const Flags& flags) {
    if (flags.link.empty() == flags.cameras.empty())
        throw Error(
            "Say which cameras: the link of a running session, or --camera for each that this "
            "computer opens itself.");
    return flags.link.empty() ? open_cameras(flags.cameras, cli::show_progress())
                              : join_for_depth(parse_link_argument(flags.link));
}

BoardSession make_session(const Cameras& cameras, const registration::LatticeTarget& target) {
    std::vector<registration::SessionCamera> about;
    for (const DepthSource::Camera& camera : cameras)
        about.push_back({camera.name, camera.calibration.depth, camera.calibration.depth_unit_mm});
    return BoardSession(std::move(about), target);
}

const char* in_words(BoardSession::Sight sight) {
    switch (sight) {
        case BoardSession::Sight::no_board:
            return "no board";
        case BoardSession::Sight::moving:
            return "hold it still";
        case BoardSession::Sight::averaging:
            return "hold on";
        case BoardSession::Sight::taken:
            return "taken, go on";
    }
    return "";
}

// Prints the state of the registration after a view.
void tell(const BoardSession& session, const Cameras& cameras, std::size_t taken,
          const Flags& flags) {
    const RigSolution solution = session.solve();
    const Vec3 span = BoardSession::span_m(solution);
    const std::string next = session.next_step(solution, flags.poses);
    nlohmann::json report{{"event", "view"},
                          {"camera", cameras[taken].name},
                          {"places", session.places()},
                          {"span_m", {span.x, span.y, span.z}},
                          {"next", next},
                          {"cameras", nlohmann::json::array()},
                          {"pairs", nlohmann::json::array()}};
    std::string line = "Place " + std::to_string(session.places()) + ", seen by " +
                       cameras[taken].name + ". Views:";
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        report["cameras"].push_back({{"camera", cameras[c].name},
                                     {"views", session.views(c)},
                                     {"coverage_ninths", session.coverage(c)}});
        line += " " + cameras[c].name + " " + std::to_string(session.views(c)) + " (" +
                std::to_string(session.coverage(c)) + "/9 of its picture)";
    }
    char text[100];
    for (const BoardSession::Pair& pair : session.pairs(solution)) {
        report["pairs"].push_back({{"a", cameras[pair.a].name},
                                   {"b", cameras[pair.b].name},
                                   {"places", pair.places},
                                   {"apart_mm", pair.apart_m * 1000}});
        std::snprintf(text, sizeof(text), ": %d common, %.1f mm apart", pair.places,
                      pair.apart_m * 1000);
        line += "; " + cameras[pair.a].name + "-" + cameras[pair.b].name + text;
    }
    if (flags.json) {
        std::cout << files::json_text(report) << std::endl;
        return;
    }
    std::snprintf(text, sizeof(text), "; places span %.1f x %.1f x %.1f m", span.x, span.y, span.z);
    std::cout << "\r\033[K" << line << text << "\n  " << next << std::endl;
}

void watch(DepthSource& source, BoardSession& session, const Flags& flags) {
    const Cameras& cameras = source.cameras();
    const TimePoint begin = steady_now();
    TimePoint next_line = begin;
    const bool live_line = !flags.json && isatty(STDOUT_FILENO);
    bool complete = false, filter_said = false;
    const auto look = [&](std::size_t camera, DepthView depth, TimePoint captured) {
        if (complete || !session.add(camera, depth, captured))
            return;
        tell(session, cameras, camera, flags);
        complete = session.is_complete(flags.poses);
        if (!cameras[camera].filter.empty() && !std::exchange(filter_said, true))
            std::fprintf(stderr,
                         "The host filters depth, which moves the board's edges a little. For the "
                         "best places start it with --filter off meanwhile.\n");
    };
    while (!complete && !cli::stop_requested() && source.next(look)) {
        if (flags.seconds > 0 && steady_now() - begin > seconds_to_duration(flags.seconds))
            return;
        if (live_line && steady_now() >= next_line) {
            std::string line;
            for (std::size_t c = 0; c < cameras.size(); ++c)
                line += (c ? "  |  " : "") + cameras[c].name + ": " + in_words(session.sight(c));
            std::cout << "\r\033[K" << line << std::flush;
            next_line = steady_now() + 200ms;
        }
    }
}

// The floor in the reference's frame, measured by the camera that sees most of it.
std::optional<registration::Plane> floor_of(const Cameras& cameras, const BoardSession& session,
                                            const RigSolution& solution) {
    std::optional<registration::Plane> floor;
    double area = 0;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const auto found =
            registration::find_floor(session.last_mean(c).view(), session.mean_unit_mm(c),
                                     make_ray_table(cameras[c].calibration.depth));
        if (!found || found->area_m2 < area)
            continue;
        area = found->area_m2;
        const Pose& pose = solution.cameras[c].reference_from_camera;
        const Vec3 normal = rotate(pose.rotation, found->plane.normal());
        const Vec3 point = pose * (found->plane.q * (1 / dot(found->plane.q, found->plane.q)));
        floor = registration::Plane{normal * (1 / dot(normal, point))};
    }
    return floor;
}

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

void save(const Cameras& cameras, const BoardSession& session, const RigSolution& solution,
          const Flags& flags) {
    Vec3 middle{};
    for (const Pose& board : solution.reference_from_board)
        middle = middle + board.translation * (1.0 / double(session.places()));
    // A place of the first camera, by hand or in its own calibration, overrides the found one.
    const Calibration& first = cameras[0].calibration;
    const auto floor = floor_of(cameras, session, solution);
    const Pose room = first.registered ? first.room_from_camera
                                       : registration::room_from_reference(floor, middle);
    const std::string found_room = first.registered ? "the first camera's own place"
                                   : floor          ? "the floor in depth"
                                           : "a guess: no floor was seen, so the first camera is "
                                             "taken to be level, 1.5 m up";
    capture::CameraPlaces places{utc_now(),
                                 "board " + flags.board.board + ", " +
                                     std::to_string(session.places()) + " places; room from " +
                                     found_room,
                                 {}};
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const registration::CameraPlace& found = solution.cameras[c];
        capture::CameraPlaces::Entry entry{
            cameras[c].name, room * found.reference_from_camera, {}, found.bias.offset_m * 1000};
        auto& covariance = entry.covariance.emplace();
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                covariance[std::size_t(6 * i + j)] = found.covariance(i, j);
        places.cameras.push_back(std::move(entry));
    }
    const std::string text = capture::write_places(places);
    files::write_file(flags.output, std::as_bytes(std::span(text)));

    nlohmann::json report{{"event", "saved"},
                          {"output", flags.output},
                          {"places", session.places()},
                          {"room", found_room},
                          {"cameras", nlohmann::json::array()}};
    if (!flags.json)
        std::cout << "\r\033[K" << flags.output << ": " << session.places()
                  << " places of the board; room from " << found_room << "\n";
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        const auto& found = solution.cameras[c];
        const double shift_mm =
            std::sqrt(found.covariance.bottomRightCorner<3, 3>().trace()) * 1000;
        const double turn_deg =
            std::sqrt(found.covariance.topLeftCorner<3, 3>().trace()) / radians_of(1);
        const double offset_mm = found.bias.offset_m * 1000,
                     sigma_mm = found.bias_sigma.offset_m * 1000;
        report["cameras"].push_back({{"camera", cameras[c].name},
                                     {"sigma_mm", shift_mm},
                                     {"sigma_deg", turn_deg},
                                     {"depth_offset_mm", offset_mm},
                                     {"depth_offset_sigma_mm", sigma_mm}});
        if (!flags.json)
            std::printf(
                "  %s: good to %.1f mm and %.2f degrees; measures %+.1f mm too far "
                "(+- %.1f)\n",
                cameras[c].name.c_str(), shift_mm, turn_deg, offset_mm, sigma_mm);
    }
    if (flags.json)
        std::cout << files::json_text(report) << std::endl;
}

void run(const Flags& flags) {
    const registration::LatticeTarget target = board_of(flags.board);
    files::require_writable(flags.output);
    const std::unique_ptr<DepthSource> source = open(flags);
    const Cameras& cameras = source->cameras();
    BoardSession session = make_session(cameras, target);
    cli::catch_stop_signals();
    if (!flags.json)
        std::cout << "Hold the board still for two seconds where two cameras or more see it, at "
                  << flags.poses << " places, nearer and farther, tilted to all sides and turned a "
                  << "little in itself.\nCtrl-C ends early and uses what there is.\n";
    watch(*source, session, flags);
    const RigSolution solution = session.solve();
    if (const std::string problem = session.problem(solution); !problem.empty())
        throw Error(problem);
    save(cameras, session, solution, flags);
}

}  // namespace

void add_register_command(CLI::App& app) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* command =
        app.add_subcommand("register", "Find out where cameras are, with a board and depth alone");
    command->footer(
        "'theatron target' draws the board. Nothing is written unless all cameras were found.\n"
        "\nExamples:\n"
        "  theatron register --camera k4a:0 --camera k4a:1 --output places.json\n"
        "  theatron register LINK --output places.json\n"
        "  theatron host --camera k4a:0 --camera k4a:1 --places places.json");
    command->add_option("link", flags->link,
                        "The link of a running session (or @FILE with it), whose cameras are used");
    cli::add_camera_option(*command, flags->cameras);
    command->add_option("--output", flags->output, "The file of places to write")->required();
    add_board_options(*command, flags->board);
    command->add_option("--poses", flags->poses, "So many places of the board for each camera")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    command->add_flag("--json", flags->json,
                      "Print one JSON line for each view and for the result");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
