// SPDX-License-Identifier: Apache-2.0
// theatron record
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "base/utc.h"
#include "cli/camera_option.h"
#include "cli/progress.h"
#include "cli/seconds_option.h"
#include "cli/stop_signal.h"
#include "client/session_recording.h"
#include "commands.h"
#include "files/file_bytes.h"
#include "host/camera_recording.h"
#include "link_argument.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::app {
namespace {

// The recording ended normally, but it is not complete.
constexpr int exit_incomplete = 3;

struct RecordFlags {
    std::vector<std::string> names;  // [LINK] FILE
    std::vector<std::string> cameras;
    std::string depth_codec = "strata";
    std::string color_codec = "jpeg:quality=85";
    std::string name = "recorder";
    double seconds = 0, wait = 0;  // 0: not given
    int buffer_mb = int(record::Recorder::Options{}.buffer_bytes >> 20);
    bool raw = false;
    bool overwrite = false;
    bool json = false;
    bool with_parent = false;
};

record::RecordCodecs check_codecs(const RecordFlags& flags) {
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

record::Recorder::Options recorder_options(const RecordFlags& flags) {
    constexpr int least_mb = 1, most_mb = 1'000'000;
    if (flags.buffer_mb < least_mb || flags.buffer_mb > most_mb)
        throw Error("--buffer is from " + std::to_string(least_mb) + " to " +
                    std::to_string(most_mb) + " megabytes.");
    return {std::size_t(flags.buffer_mb) << 20, flags.overwrite};
}

std::unique_ptr<record::RecordSource> open_source(const RecordFlags& flags) {
    const record::RecordCodecs codecs = check_codecs(flags);
    const record::Recorder::Options options = recorder_options(flags);
    const std::string& file = flags.names.back();
    if (const std::string problem = record::name_problem(file); !problem.empty())
        throw Error(problem);
    files::require_new(file, flags.overwrite);
    if (flags.cameras.empty()) {
        if (flags.names.size() != 2)
            throw Error(
                "Say what to record: 'theatron record LINK FILE.mkv' or 'theatron record "
                "--camera SPEC FILE.mkv'.");
        return client::record_session(
            parse_link_argument(flags.names[0]), flags.name, file, codecs, options,
            flags.wait > 0 ? std::optional(seconds_to_duration(flags.wait)) : std::nullopt,
            // One of the host's own recordings that was removed must not keep out the next one.
            flags.with_parent ? std::filesystem::path() : files::state_folder());
    }
    if (flags.names.size() != 1)
        throw Error("With --camera, only the file to record into can be named.");
    return host::record_cameras(flags.cameras, file, codecs, options, cli::show_progress());
}

double free_gigabytes(const std::string& file) {
    std::error_code problem;
    const auto space =
        std::filesystem::space(std::filesystem::absolute(file).parent_path(), problem);
    return problem ? 0 : double(space.available) * 1e-9;
}

std::string status_line(const record::Recorder::Figures& f, std::uint64_t missing,
                        const std::string& file) {
    const double seconds = to_seconds(f.duration), megabytes = double(f.bytes) * 1e-6;
    const int minutes = int(seconds) / 60;
    char text[160];
    std::snprintf(text, sizeof(text),
                  "%02d:%04.1f  %.1f MB  %.1f Mbit/s  %llu pictures, %llu lost  %.1f GB free",
                  minutes, seconds - 60.0 * minutes, megabytes,
                  seconds > 0 ? megabytes * 8 / seconds : 0, (unsigned long long)f.frames,
                  (unsigned long long)missing, free_gigabytes(file));
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

// Pictures that were not recorded, or that never came.
struct Missing {
    std::uint64_t lost = 0, dropped = 0, interruptions = 0;
    bool any() const { return lost + dropped + interruptions > 0; }
};

// Prints the content of the recording for each camera, and the sums of missing pictures.
nlohmann::json describe(record::RecordSource& source, TimePoint begin, Missing& missing) {
    nlohmann::json cameras = nlohmann::json::array();
    for (const record::Intake::Stream& stream : source.intake().streams(steady_now())) {
        const CameraId camera = camera_of(stream.id);
        if (cameras.empty() || cameras.back()["camera"] != int(camera)) {
            cameras.push_back({{"camera", int(camera)},
                               {"name", stream.camera},
                               {"not_encoded", source.not_encoded(camera)},
                               {"lost_in_source", source.lost_in_source(camera)},
                               {"was_gone", source.was_gone(camera)}});
            missing.lost += source.not_encoded(camera) + source.lost_in_source(camera);
            missing.interruptions += source.was_gone(camera);
        }
        const auto time = [&](const std::optional<TimePoint>& came) {
            return came ? nlohmann::json(to_seconds(std::max(*came - begin, Duration(0))))
                        : nlohmann::json();
        };
        cameras.back()[is_depth(stream.id) ? "depth" : "color"] = {
            {"pictures", stream.figures.recorded}, {"lost", stream.figures.lost},
            {"dropped", stream.figures.dropped},   {"interruptions", stream.interruptions},
            {"first_seconds", time(stream.first)}, {"last_seconds", time(stream.last)}};
        missing.lost += stream.figures.lost;
        missing.dropped += stream.figures.dropped;
        missing.interruptions += stream.interruptions + (stream.figures.recorded == 0);
    }
    return cameras;
}

nlohmann::json describe_voices(const std::vector<record::Intake::Voice>& voices) {
    nlohmann::json list = nlohmann::json::array();
    for (const record::Intake::Voice& voice : voices)
        list.push_back({{"participant", std::uint32_t(voice.who.person)},
                        {"name", voice.who.name},
                        {"packets", voice.figures.packets},
                        {"missing", voice.figures.missing},
                        {"left_out", voice.figures.left_out},
                        {"dropped", voice.dropped},
                        {"interruptions", voice.interruptions}});
    return list;
}

// Replaces the counts of pictures that came by those of the finished file, and counts the others,
// which waited when the recording ended by itself.
void count_written(nlohmann::json& cameras, const record::Intake& intake,
                   const record::Recorder::Figures& written, Missing& missing) {
    for (const record::Intake::Stream& stream : intake.streams(steady_now())) {
        const auto found = written.frames_of.find(stream.id);
        const std::uint64_t frames = found == written.frames_of.end() ? 0 : found->second;
        const std::uint64_t came = stream.figures.recorded;
        for (nlohmann::json& camera : cameras)
            if (camera["camera"] == int(camera_of(stream.id))) {
                nlohmann::json& json = camera[is_depth(stream.id) ? "depth" : "color"];
                json["pictures"] = frames;
                json["not_written"] = came - std::min(came, frames);
            }
        missing.dropped += came - std::min(came, frames);
    }
}

// Checks that the files of the recording still exist.
class FileWatch {
public:
    // Returns those of `files` that were deleted or renamed since the last call. A file is
    // identified when it is seen first.
    std::vector<std::filesystem::path> gone(const std::vector<std::filesystem::path>& files) {
        std::vector<std::filesystem::path> gone;
        for (const std::filesystem::path& path : files) {
            Known& known = known_[path];
            struct stat info {};
            const bool is_there = stat(path.c_str(), &info) == 0;
            const auto identity =
                is_there ? std::optional(std::pair(info.st_dev, info.st_ino)) : std::nullopt;
            if (!known.identity)
                known.identity = identity;
            if (identity && identity == known.identity)
                continue;
            if (!std::exchange(known.told, true))
                gone.push_back(path);
        }
        return gone;
    }

private:
    struct Known {
        std::optional<std::pair<dev_t, ino_t>> identity;
        bool told = false;
    };
    std::map<std::filesystem::path, Known> known_;
};

// Names the folder if that is not there any more either.
std::string what_is_gone(const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    std::error_code ignored;
    const bool has_folder = std::filesystem::exists(folder, ignored);
    return (has_folder ? "'" + file.string() : "The folder '" + folder.string()) +
           "' was deleted or renamed";
}

// Age of the newest picture that has arrived.
Duration behind(record::RecordSource& source) {
    const auto newest = source.intake().newest_captured();
    return newest ? std::max(source.now().clock.session - *newest, Duration{}) : Duration{};
}

// At the end of a recording: takes pictures of the time before that the host still has. False if
// some did not come.
template <class Say>
bool fetch_rest(record::RecordSource& source, const Say& say) {
    constexpr Duration usual_delay = 1s, patience = 20s, no_progress = 3s, least_patience = 1500ms;
    if (!source.is_connected())
        return false;
    if (behind(source) <= usual_delay)
        return true;
    say("Fetching what the host still has for this recording.");
    const TimePoint begin = steady_now(), end_of_recording = source.now().clock.session;
    TimePoint progressed = begin;
    std::optional<TimePoint> newest;
    const auto is_silent = [&] {
        return source.is_silent() && steady_now() - begin >= least_patience;
    };
    while (source.is_connected() && !is_silent() && steady_now() - begin < patience &&
           steady_now() - progressed < no_progress) {
        std::this_thread::sleep_for(20ms);
        source.tick();
        const auto came = source.intake().newest_captured();
        if (came && *came >= end_of_recording - usual_delay)
            return true;
        if (std::exchange(newest, came) != came)
            progressed = steady_now();
    }
    return false;
}

// From the wish to end until the file has its end: fetch_rest(), and a slow disk.
constexpr Duration file_patience = std::chrono::seconds(30);

void run(const RecordFlags& flags) {
    cli::catch_stop_signals();
    // As if it were asked to end; the parent may have ended before.
    if (flags.with_parent && (prctl(PR_SET_PDEATHSIG, SIGTERM) != 0 || getppid() == 1))
        throw Error("The program that was to end this recording has ended before.");
    std::optional<cli::Saving> saving(file_patience);
    const std::string& file = flags.names.back();
    const std::unique_ptr<record::RecordSource> source = open_source(flags);
    record::Intake& intake = source->intake();
    const bool live_line = !flags.json && isatty(STDOUT_FILENO);
    const auto say = [](const std::string& text) { log::say(text); };
    FileWatch watch;
    std::set<std::string> gone_files;
    auto say_cut = [&, said = std::uint64_t(0)](const record::Recorder::Figures& f) mutable {
        if (f.cut_bytes > said)
            say("Another program has cut " + std::to_string(f.cut_bytes - said) +
                " bytes off the recording's file; the recording goes on behind them.");
        said = f.cut_bytes;
    };
    std::optional<record::RecordSource::End> end;
    TimePoint begin{}, next_look{};
    double cpu_before = 0;

    while (!cli::stop_requested() && !(end = source->ended())) {
        std::this_thread::sleep_for(20ms);
        source->tick();
        for (const std::string& sentence : intake.news(steady_now()))
            say(sentence);
        if (!intake.problem().empty())
            break;
        const record::Recorder* recorder = intake.recorder();
        if (!recorder)
            continue;
        const TimePoint now = steady_now();
        if (begin == TimePoint{}) {
            begin = now;
            cpu_before = cpu_seconds();
        }
        if (flags.seconds > 0 && now - begin >= seconds_to_duration(flags.seconds))
            break;
        if (now < next_look)
            continue;
        next_look = now + 500ms;
        say_cut(recorder->figures());
        const auto files = recorder->files();
        for (const std::filesystem::path& gone : watch.gone(files)) {
            const bool is_written = gone == files.back();
            say(what_is_gone(gone) + (is_written
                                          ? "; the recording goes on in a new file."
                                          : "; it is a part of this recording, which goes on."));
            gone_files.insert(gone.string());
            if (is_written)
                intake.begin_segment();
        }
        if (live_line) {
            Missing missing;
            describe(*source, begin, missing);
            output::status_line(
                status_line(recorder->figures(), missing.lost + missing.dropped, file));
        }
    }
    const bool has_rest =
        !intake.recorder() || end || !intake.problem().empty() || fetch_rest(*source, say);
    const double missing_end = has_rest ? 0 : to_seconds(behind(*source));
    if (!has_rest)
        say("The last " + std::to_string(int(missing_end + 0.5)) +
            " s before the end did not come from the host.");
    const double wall = to_seconds(steady_now() - begin), cpu = cpu_seconds() - cpu_before;
    Missing missing;
    source->stop();
    intake.take_held();
    nlohmann::json cameras = describe(*source, begin, missing);
    record::Recorder* recorder = intake.recorder();
    if (!recorder)
        throw Error(intake.problem().empty()
                        ? "Stopped before anything came, so nothing was recorded."
                        : intake.problem());
    recorder->finish();
    if (end && !end->remark.empty())
        say(end->remark);

    const record::Recorder::Figures f = recorder->figures();
    count_written(cameras, intake, f, missing);
    say_cut(f);
    for (const std::filesystem::path& gone : watch.gone(recorder->files())) {
        say(what_is_gone(gone) + " while the recording went on.");
        gone_files.insert(gone.string());
    }
    record::Lacks lacks;
    const auto note = [&](bool is_so, record::Lack lack) {
        if (is_so)
            lacks.insert(lack);
    };
    note(!has_rest, record::Lack::end);
    note(missing.any(), record::Lack::pictures);
    const std::vector<record::Intake::Voice> voices = intake.voices();
    note(std::ranges::any_of(voices, [](const auto& v) { return v.dropped + v.interruptions > 0; }),
         record::Lack::voices);
    note(!gone_files.empty(), record::Lack::files);
    note(f.cut_bytes > 0, record::Lack::cut);
    note(!f.problem.empty(), record::Lack::index);
    if (end && end->lack)
        lacks.insert(*end->lack);
    recorder->note_lacks(lacks);
    const bool complete = lacks.empty();
    saving.reset();
    cli::begin_end(!f.problem.empty() ? 1 : complete ? 0 : exit_incomplete);
    if (flags.json)
        output::result(nlohmann::json{{"file", file},
                                      {"utc", utc_text(utc_now())},
                                      {"segments", f.segments},
                                      {"seconds", to_seconds(f.duration)},
                                      {"bytes", f.bytes},
                                      {"pictures", f.frames},
                                      {"dropped", missing.dropped},
                                      {"lost", missing.lost},
                                      {"room_bytes", f.room_bytes},
                                      {"voice_bytes", f.voice_bytes},
                                      {"voices", describe_voices(voices)},
                                      {"voices_not_agreed", source->voices_not_agreed()},
                                      {"not_agreed", source->not_agreed()},
                                      {"cut_bytes", f.cut_bytes},
                                      {"gone_files", gone_files},
                                      {"missing_end_seconds", missing_end},
                                      {"complete", complete},
                                      {"cameras", std::move(cameras)},
                                      {"cpu_cores", cpu / wall},
                                      {"problem", f.problem}}
                           .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                       "\n");
    else
        output::print(status_line(f, missing.lost + missing.dropped, file) + "\n");
    if (!f.problem.empty())
        throw Error(f.problem);
    if (!complete) {
        say("Something is missing in this recording; --json lists what, camera by camera.");
        throw CLI::RuntimeError(exit_incomplete);
    }
}

}  // namespace

void add_record_command(CLI::App& app) {
    const auto flags = std::make_shared<RecordFlags>();
    CLI::App* command = app.add_subcommand("record", "Record a session, or cameras, into a file");
    command->footer(
        "The streams are written as they are encoded, and play again with recording:FILE.mkv,\n"
        "camera by camera; colour plays in ordinary players. Cameras of one's own are recorded as\n"
        "they are, before any filter. Whatever happens, the file opens up to its last moments.\n"
        "Ctrl-C ends the recording.\n"
        "Exit code 0: every picture is in it; 3: something is missing; 1: it could not be made, "
        "or\n"
        "the disk ended it.\n"
        "\nExamples:\n"
        "  theatron record LINK operation.mkv --seconds 60\n"
        "  theatron record --camera folder:left,loop=1 --camera folder:right,loop=1 both.mkv\n"
        "  theatron host --camera recording:both.mkv,loop=1 --camera "
        "recording:both.mkv,camera=1,loop=1");
    command
        ->add_option("what", flags->names,
                     "The link of a session (or @FILE with it), unless --camera is given, "
                     "and the file to write")
        ->required()
        ->expected(1, 2);
    cli::add_camera_option(*command, flags->cameras);
    command->add_option("--depth-codec", flags->depth_codec, "How depth is encoded")
        ->capture_default_str();
    command->add_option("--color-codec", flags->color_codec, "How colour is encoded")
        ->capture_default_str();
    command->add_flag("--raw", flags->raw,
                      "Insist on depth exactly as the cameras give it: refuse a lossy depth codec");
    cli::add_seconds_option(*command, flags->seconds, "End by itself after this time");
    command->add_option("--name", flags->name, "Name of this recording, shown in the session")
        ->capture_default_str();
    cli::add_seconds_option(
        *command, flags->wait,
        "How long to wait for a host that is not there (at the beginning 15, after a "
        "loss until told to end)",
        "--wait");
    command
        ->add_option("--buffer", flags->buffer_mb,
                     "Megabytes of pictures that may wait for a disk that stands still")
        ->capture_default_str();
    command->add_flag("--overwrite", flags->overwrite, "Replace a file that is there");
    command->add_flag("--with-parent", flags->with_parent,
                      "End, as by Ctrl-C, with the program that has started it");
    command->add_flag("--json", flags->json, "Print the figures as one JSON line at the end");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
