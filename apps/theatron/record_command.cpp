// SPDX-License-Identifier: Apache-2.0
// theatron record
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "camera_option.h"
#include "commands.h"
#include "progress.h"
#include "record_source.h"
#include "stop_signal.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::app {
namespace {

struct Flags {
    std::vector<std::string> names;  // [LINK] FILE
    std::vector<std::string> cameras;
    std::string depth_codec = "strata";
    std::string color_codec = "jpeg:quality=85";
    double seconds = 0;
    bool raw = false;
    bool overwrite = false;
    bool json = false;
};

RecordCodecs check_codecs(const Flags& flags) {
    const auto depth = video::parse_depth_setting(flags.depth_codec);
    const auto color = video::parse_color_setting(flags.color_codec);
    // A session's host encodes; one's own cameras are encoded here.
    const std::string missing =
        flags.cameras.empty() ? "" : video::missing_color_encoder(color.setting);
    for (const std::string& problem : {depth.problem, color.problem, missing})
        if (!problem.empty())
            throw Error(problem);
    if (flags.raw && flags.cameras.empty())
        throw Error("--raw goes with --camera: what a session's host sends is no longer raw.");
    if (flags.raw && !video::make_depth_codec(depth.setting)->lossless())
        throw Error("With --raw depth must be lossless, which '" + flags.depth_codec +
                    "' is not; choose strata, trvl, rvl, ans, zstd, lz4 or raw.");
    return {depth.setting.text, color.setting.text};
}

std::unique_ptr<RecordSource> open_source(const Flags& flags) {
    const RecordCodecs codecs = check_codecs(flags);
    const std::string& file = flags.names.back();
    if (!flags.overwrite && std::filesystem::exists(file))
        throw Error("'" + file + "' exists already; name another file, or give --overwrite.");
    if (flags.cameras.empty()) {
        if (flags.names.size() != 2)
            throw Error(
                "Say what to record: 'theatron record LINK FILE.mkv' or 'theatron record "
                "--camera SPEC FILE.mkv'.");
        return record_session(net::parse_link(flags.names[0]), file, codecs);
    }
    if (flags.names.size() != 1)
        throw Error("With --camera, only the file to record into can be named.");
    return record_cameras(flags.cameras, file, codecs, show_progress());
}

double free_gigabytes(const std::string& file) {
    std::error_code problem;
    const auto space =
        std::filesystem::space(std::filesystem::absolute(file).parent_path(), problem);
    return problem ? 0 : double(space.available) * 1e-9;
}

std::string status_line(const record::Recorder::Figures& f, std::uint64_t lost,
                        const std::string& file) {
    const double seconds = to_seconds(f.duration), megabytes = double(f.bytes) * 1e-6;
    char text[160];
    std::snprintf(text, sizeof(text),
                  "%02d:%04.1f  %.1f MB  %.1f Mbit/s  %llu pictures, %llu lost  %.1f GB free",
                  int(seconds) / 60, seconds - int(seconds) / 60 * 60, megabytes,
                  seconds > 0 ? megabytes * 8 / seconds : 0, (unsigned long long)f.frames,
                  (unsigned long long)(f.dropped + lost), free_gigabytes(file));
    return text;
}

double cpu_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return double(t.tv_sec) + double(t.tv_usec) * 1e-6;
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void run(const Flags& flags) {
    catch_stop_signals();
    const std::string& file = flags.names.back();
    const std::unique_ptr<RecordSource> source = open_source(flags);
    const bool live_line = !flags.json && isatty(STDOUT_FILENO);
    std::string remark;
    TimePoint begin{}, next_line{};
    double cpu_before = 0;

    while (!stop_requested() && !source->ended(remark)) {
        std::this_thread::sleep_for(20ms);
        source->tick();
        const record::Recorder* recorder = source->recorder();
        if (!recorder)
            continue;
        const TimePoint now = steady_now();
        if (begin == TimePoint{}) {
            begin = now;
            cpu_before = cpu_seconds();
        }
        if (!recorder->figures().problem.empty() ||
            (flags.seconds > 0 && now - begin >= seconds_to_duration(flags.seconds)))
            break;
        if (live_line && now >= next_line) {
            std::cout << "\r\033[K" << status_line(recorder->figures(), source->lost(), file)
                      << std::flush;
            next_line = now + 500ms;
        }
    }
    const double wall = to_seconds(steady_now() - begin), cpu = cpu_seconds() - cpu_before;
    const std::uint64_t lost = source->lost();
    source->stop();
    record::Recorder* recorder = source->recorder();
    if (!recorder)
        throw Error("Stopped before the first picture came, so nothing was recorded.");
    recorder->finish();
    if (live_line)
        std::cout << "\r\033[K";
    if (!remark.empty())
        std::fprintf(stderr, "%s\n", remark.c_str());

    const record::Recorder::Figures f = recorder->figures();
    if (flags.json)
        std::cout << nlohmann::json{{"file", file},
                                    {"seconds", to_seconds(f.duration)},
                                    {"bytes", f.bytes},
                                    {"pictures", f.frames},
                                    {"dropped", f.dropped},
                                    {"lost", lost},
                                    {"cpu_cores", cpu / wall},
                                    {"problem", f.problem}}
                         .dump()
                  << std::endl;
    else
        std::cout << status_line(f, lost, file) << std::endl;
    if (!f.problem.empty())
        throw Error(f.problem);
}

}  // namespace

void add_record_command(CLI::App& app) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("record", "Record a session, or cameras, into a file");
    command->footer(
        "The streams are written as they are encoded, and play again with recording:FILE.mkv,\n"
        "camera by camera; colour plays in ordinary players. Cameras of one's own are recorded as\n"
        "they are, before any filter. Whatever happens, the file opens up to its last moments.\n"
        "Ctrl-C ends the recording.\n"
        "\nExamples:\n"
        "  theatron record LINK operation.mkv --seconds 60\n"
        "  theatron record --camera folder:left,loop=1 --camera folder:right,loop=1 both.mkv\n"
        "  theatron host --camera recording:both.mkv,loop=1 --camera "
        "recording:both.mkv,camera=1,loop=1");
    command
        ->add_option("what", flags->names,
                     "The link of a session, unless --camera is given, "
                     "and the file to write")
        ->required()
        ->expected(1, 2);
    add_camera_option(*command, flags->cameras);
    command->add_option("--depth-codec", flags->depth_codec, "How depth is encoded")
        ->capture_default_str();
    command->add_option("--color-codec", flags->color_codec, "How colour is encoded")
        ->capture_default_str();
    command->add_flag("--raw", flags->raw,
                      "Insist on depth exactly as the cameras give it: refuse a lossy depth codec");
    command->add_option("--seconds", flags->seconds, "End by itself after this time");
    command->add_flag("--overwrite", flags->overwrite, "Replace a file that is there");
    command->add_flag("--json", flags->json, "Print the figures as one JSON line at the end");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
