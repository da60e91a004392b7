// SPDX-License-Identifier: Apache-2.0
// theatron register
#include <algorithm>
#include <cstdio>
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
#include "register_result.h"
#include "registration/board_session.h"
#include "registration/pose_line.h"
#include "registration/touched_corners.h"
#include "registration/tracked_holder.h"

namespace theatron::app {
namespace {

using registration::BoardSession;
using registration::RigSolution;

struct RegisterFlags {
    std::string link;
    std::vector<std::string> cameras, only;
    BoardFlags board;
    std::string refine;   // a file of places
    std::string touches;  // a file, or - for standard input
    std::string tip = "0:0:0";
    std::string holder;  // a file, or - for standard input
    std::string holder_offset = "0:0:0:1:0:0:0";
    RigOutput output;
    int poses = 10;
    double seconds = 0;
};

std::unique_ptr<DepthSource> open(const RegisterFlags& flags, const WantedCameras& choice) {
    if (flags.link.empty() == flags.cameras.empty())
        throw Error(
            "Say which cameras: the link of a running session, or --camera for each that this "
            "computer opens itself.");
    return flags.link.empty() ? open_cameras(flags.cameras, choice, cli::show_progress())
                              : join_for_depth(parse_link_argument(flags.link), choice);
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
void tell(const BoardSession& session, const RigSolution& solution, const Cameras& cameras,
          std::size_t taken, const RegisterFlags& flags) {
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
        if (pair.places == 0)
            continue;
        std::snprintf(text, sizeof(text),
                      solution.converged ? ": %d common, %.1f mm apart" : ": %d common",
                      pair.places, pair.apart_m * 1000);
        line += "; " + cameras[pair.a].name + "-" + cameras[pair.b].name + text;
    }
    if (flags.output.json) {
        std::cout << files::json_text(report) << std::endl;
        return;
    }
    std::snprintf(text, sizeof(text), "; places span %.1f x %.1f x %.1f m", span.x, span.y, span.z);
    std::cout << clear_line() << line << text << "\n  " << next << std::endl;
}

void watch(DepthSource& source, BoardSession& session, const RegisterFlags& flags) {
    const Cameras& cameras = source.cameras();
    const TimePoint begin = steady_now();
    TimePoint next_line = begin;
    const bool live_line = !flags.output.json && *clear_line() != 0;
    bool complete = false, filter_said = false;
    const auto look = [&](std::size_t camera, DepthView depth, TimePoint captured) {
        if (complete || !session.add(camera, depth, captured))
            return;
        const RigSolution solution = session.solve();
        tell(session, solution, cameras, camera, flags);
        complete = session.is_complete(solution, flags.poses);
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
            std::cout << clear_line() << line << std::flush;
            next_line = steady_now() + 200ms;
        }
    }
}

// The text of a file, or of standard input to its end.
std::string typed_or_file(const std::string& file, const RegisterFlags& flags,
                          const char* request) {
    constexpr std::size_t max_text_bytes = 1 << 16;
    if (file != "-") {
        const Bytes bytes = files::read_file(file, max_text_bytes);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    if (!flags.output.json)
        std::cout << request << "\n";
    std::string text;
    char c = 0;
    while (text.size() < max_text_bytes && std::cin.get(c))
        text += c;
    return text;
}

// Where the tip is in the controller's frame. Throws Error with a sentence.
Vec3 tip_of(const RegisterFlags& flags) {
    const auto tip = capture::parse_place(flags.tip);
    if (!tip || std::count(flags.tip.begin(), flags.tip.end(), ':') != 2)
        throw Error("--tip " + flags.tip + " is not X:Y:Z in metres.");
    return tip->translation;
}

// Where the board is in the controller's frame. Throws Error with a sentence.
Pose holder_offset_of(const RegisterFlags& flags) {
    std::string words = flags.holder_offset;
    std::replace(words.begin(), words.end(), ':', ' ');
    const auto offset = registration::parse_pose(registration::words_of(words, 7));
    if (!offset)
        throw Error("--holder-offset " + flags.holder_offset +
                    " is not X:Y:Z or X:Y:Z:QW:QX:QY:QZ in metres.");
    return *offset;
}

// The room by a controller's tip at the board's corners. Throws Error with a sentence.
RoomFrame touched_room(const RegisterFlags& flags, const registration::LatticeTarget& target,
                       const RigSolution& solution) {
    const auto parsed = registration::parse_touches(
        typed_or_file(flags.touches, flags,
                      "Leave the board where it is and give the touches of its corners, one "
                      "'CORNER X Y Z' a line; Ctrl-D ends."),
        tip_of(flags));
    if (!parsed.problem.empty())
        throw Error(parsed.problem);
    const registration::TouchFit fit = registration::fit_touches(target, parsed.touches);
    if (!fit.problem.empty())
        throw Error(fit.problem);
    return {fit.room_from_board * inverse(solution.reference_from_board.back()),
            "the touched corners of the board"};
}

// The room by a controller that carries the board. Throws Error with a sentence.
RoomFrame held_room(const RegisterFlags& flags, const registration::LatticeTarget& target,
                    const RigSolution& solution) {
    const auto parsed = registration::parse_holder(typed_or_file(
        flags.holder, flags,
        "Give the controller's pose at places of the board, one 'PLACE X Y Z QW QX QY QZ' a line; "
        "Ctrl-D ends."));
    if (!parsed.problem.empty())
        throw Error(parsed.problem);
    const registration::HolderFit fit = registration::fit_holder(
        target, solution.reference_from_board, holder_offset_of(flags), parsed.poses);
    if (!fit.problem.empty())
        throw Error(fit.problem);
    return {fit.room_from_reference, "the board's tracked holder"};
}

// Means of some images of each camera, for --refine.
std::vector<registration::FrameMean> still_images(DepthSource& source, const RegisterFlags& flags) {
    constexpr Duration patience = std::chrono::seconds(20);
    const Duration longest = flags.seconds > 0 ? seconds_to_duration(flags.seconds) : patience;
    std::vector<registration::FrameMean> means;
    for (const DepthSource::Camera& camera : source.cameras())
        means.emplace_back(camera.calibration.depth.size);
    const auto add = [&](std::size_t camera, DepthView depth, TimePoint) {
        if (means[camera].frames() < BoardSession::frames_per_view)
            means[camera].add(depth);
    };
    const auto is_enough = [](const registration::FrameMean& mean) {
        return mean.frames() >= BoardSession::frames_per_view;
    };
    const TimePoint begin = steady_now();
    while (!std::all_of(means.begin(), means.end(), is_enough) && steady_now() - begin < longest &&
           !cli::stop_requested() && source.next(add)) {
    }
    for (std::size_t c = 0; c < means.size(); ++c)
        if (means[c].frames() == 0)
            throw Error("The camera '" + source.cameras()[c].name + "' gave no pictures.");
    return means;
}

void check_outputs(const RigOutput& output) {
    for (const std::string& file : {output.places, output.report})
        if (!file.empty())
            files::require_writable(file);
    if (!output.report.empty() && std::filesystem::weakly_canonical(output.report) ==
                                      std::filesystem::weakly_canonical(output.places))
        throw Error("--output and --report name the same file; name two.");
    files::require_own_kind(output.places, "{", "a file of places");
    if (!output.report.empty())
        files::require_own_kind(output.report, "<!doctype html>", "a report");
}

void run(const RegisterFlags& flags) {
    const registration::LatticeTarget target = board_of(flags.board);
    // Mistyped ones are told before anybody carries the board.
    (void)tip_of(flags);
    (void)holder_offset_of(flags);
    WantedCameras choice{flags.only, {}};
    capture::CameraPlaces earlier;
    if (!flags.refine.empty()) {
        earlier = capture::load_places(flags.refine);
        choice.known.emplace();
        for (const capture::CameraPlaces::Entry& entry : earlier.cameras)
            choice.known->insert(entry.camera);
    }
    check_outputs(flags.output);
    const std::unique_ptr<DepthSource> source = open(flags, choice);
    const Cameras& cameras = source->cameras();
    BoardSession session = make_session(cameras, target);
    cli::catch_stop_signals();
    // Ctrl-C ends the looking, and what was seen is solved then.
    const cli::Saving saving(std::chrono::minutes(2));
    if (!flags.refine.empty())
        return save(rig_of_surfaces(cameras, earlier, still_images(*source, flags)), flags.output);
    if (!flags.output.json)
        std::cout << "Hold the board still for two seconds where two cameras or more see it, at "
                  << flags.poses << " places, nearer and farther, tilted to all sides and turned a "
                  << "little in itself.\nCtrl-C ends early and uses what there is.\n";
    watch(*source, session, flags);
    const RigSolution solution = session.solve();
    if (const std::string problem = session.problem(solution); !problem.empty())
        throw Error(problem);
    std::optional<RoomFrame> room;
    if (!flags.touches.empty())
        room = touched_room(flags, target, solution);
    else if (!flags.holder.empty())
        room = held_room(flags, target, solution);
    save(rig_of_board(cameras, session, solution, "board " + flags.board.board, room),
         flags.output);
}

}  // namespace

void add_register_command(CLI::App& app) {
    const auto flags = std::make_shared<RegisterFlags>();
    CLI::App* command =
        app.add_subcommand("register", "Find out where cameras are, with a board and depth alone");
    command->footer(
        "'theatron target' draws the board. Nothing is written unless all cameras were found.\n"
        "\nExamples:\n"
        "  theatron register --camera k4a:0 --camera k4a:1 --output places.json\n"
        "  theatron register LINK --output places.json --report report.html\n"
        "  theatron register LINK --refine places.json --output better.json\n"
        "  theatron host --camera k4a:0 --camera k4a:1 --places places.json");
    command->add_option("link", flags->link,
                        "The link of a running session (or @FILE with it), whose cameras are used");
    cli::add_camera_option(*command, flags->cameras);
    command
        ->add_option("--only", flags->only,
                     "Of all those cameras the one with this name; repeat for more. Screens and "
                     "cameras that move with a person are left out anyway")
        ->allow_extra_args(false);
    command->add_option("--output", flags->output.places, "The file of places to write")
        ->required();
    command->add_option("--report", flags->output.report,
                        "Also write a report with drawings: one HTML file");
    command->add_option(
        "--touches", flags->touches,
        "The room's frame from a tracked controller: a file (- is standard input, read when the "
        "views are taken) with lines CORNER X Y Z or CORNER X Y Z QW QX QY QZ, metres in the room, "
        "for three corners or more of the board at its last place: A is the corner with the three "
        "filled cells, then B, C, D clockwise, seen from the front");
    command
        ->add_option(
            "--holder", flags->holder,
            "The room's frame from the board in a holder on a tracked controller: a file (- is "
            "standard input, read when the views are taken) with a line PLACE X Y Z QW QX QY QZ "
            "for "
            "one place of the board or more, counted from 1 as they are printed: the controller's "
            "pose in the room, metres")
        ->excludes("--touches");
    command
        ->add_option("--holder-offset", flags->holder_offset,
                     "With --holder: the board in the controller's frame, X:Y:Z or "
                     "X:Y:Z:QW:QX:QY:QZ in metres: the middle of its front face, x to the right, y "
                     "up, seen from the front")
        ->needs("--holder")
        ->capture_default_str();
    command
        ->add_option("--tip", flags->tip,
                     "With --touches: the tip that touches, in the controller's frame, X:Y:Z in "
                     "metres")
        ->needs("--touches")
        ->capture_default_str();
    add_board_options(*command, flags->board);
    command->add_option("--poses", flags->poses, "Number of places of the board for each camera")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    CLI::Option* refine =
        command->add_option("--refine", flags->refine,
                            "Without a board: improve the places of this file on surfaces that two "
                            "cameras see, for example after one was moved a little");
    for (const char* of_board : {"--board", "--thickness", "--poses", "--touches", "--holder"})
        refine->excludes(of_board);
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    command->add_flag("--json", flags->output.json,
                      "Print one JSON line for each view and for the result");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
