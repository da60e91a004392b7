// SPDX-License-Identifier: Apache-2.0
// theatron export
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "cli/number_check.h"
#include "cli/progress.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "export/export_formats.h"
#include "export/export_places.h"
#include "export/room_of_recording.h"
#include "export/voices_of_recording.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "host/filter_choice.h"
#include "record/remarks.h"

namespace theatron::app {
namespace {

struct ExportFlags {
    std::string file;
    std::string ply, png, k4a, room, voices;
    std::optional<int> camera;
    double from = 0, to = 0;  // seconds; to: 0: not given
    int every = 1;
    bool merged = false;
    bool undistort = false;
    bool registered = false;
    bool overwrite = false;
    bool json = false;
};

using Recording = std::shared_ptr<const record::RecordingFile>;

// The cameras that have a calibration of this number: one after the other, they count from 0.
exporting::ExportSource open_source(const ExportFlags& flags, const Recording& recording,
                                    std::size_t calibration) {
    exporting::ExportSource source;
    source.progress = [show = cli::show_progress()](std::string_view step, double done) {
        if (cli::stop_requested())
            throw Error(
                "Stopped before the end of the recording: pictures and points that were written "
                "so far stay, a file is only written as a whole.");
        if (show)
            show(step, done);
    };
    source.selection.from = seconds_to_duration(flags.from);
    if (flags.to > 0)
        source.selection.to = seconds_to_duration(flags.to);
    source.selection.every = std::size_t(flags.every);
    const std::size_t count = recording->cameras().size();
    source.one_camera = flags.camera || count == 1;
    for (std::size_t i = 0; i < count || (flags.camera && i == std::size_t(*flags.camera)); ++i) {
        if (flags.camera && i != std::size_t(*flags.camera))
            continue;
        if (i < count && calibration >= capture::calibrations_of(recording->cameras()[i]))
            continue;
        source.cameras.push_back(
            std::make_unique<capture::RecordedFrames>(recording, i, flags.file, calibration));
        source.numbers.push_back(i);
        if (flags.from > 0)
            source.cameras.back()->go_to(source.selection.from);
        // After a change of its calibration it may have no frame of that time.
        if (flags.from + flags.to > 0 && !source.next(source.cameras.size() - 1)) {
            source.cameras.pop_back();
            source.numbers.pop_back();
        }
    }
    return source;
}

// Counts of pictures that were exported and of those that were lost.
struct Exported {
    std::size_t count = 0;
    capture::PictureLosses losses;
    // One for each calibration, with the number of its pictures.
    std::vector<std::pair<std::filesystem::path, std::size_t>> places;

    void add(const exporting::ExportSource& source, std::filesystem::path place,
             std::size_t written) {
        count += written;
        places.emplace_back(std::move(place), written);
        for (const auto& camera : source.cameras) {
            const capture::PictureLosses& l = camera->losses();
            losses.damaged_depth += l.damaged_depth;
            losses.damaged_color += l.damaged_color;
            losses.undecodable_depth += l.undecodable_depth;
            losses.undecodable_color += l.undecodable_color;
        }
        losses.damaged_color += source.undecoded_color;
    }
};

// All lines that name filters which the depth went through before it was recorded.
std::vector<std::string> filters_of(const record::RecordingFile& recording,
                                    std::optional<int> camera) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < recording.cameras().size(); ++i)
        if (!camera || std::size_t(*camera) == i)
            for (const record::FilterChange& change : recording.cameras()[i].depth.filters)
                if (!change.filters.empty() &&
                    std::find(lines.begin(), lines.end(), change.filters) == lines.end())
                    lines.push_back(change.filters);
    return lines;
}

void say_places(const exporting::ExportSource& source) {
    std::string names, of_people;
    for (const auto& camera : source.cameras)
        if (camera->info().calibration.person != 0)
            of_people += (of_people.empty() ? "" : ", ") + camera->info().name;
        else if (!camera->info().calibration.registered)
            names += (names.empty() ? "" : ", ") + camera->info().name;
    if (!of_people.empty())
        std::cerr << "Not merged, because they see people who move: " << of_people
                  << ". Without --merged the points of each are exported in its own frame."
                  << std::endl;
    if (!names.empty() && source.cameras.size() > 1)
        std::cerr << "Nobody knows where these cameras were in the room: " << names
                  << ". Their points lie on each other as if all had stood at one place; "
                     "'theatron register' finds places for the next recording."
                  << std::endl;
}

// False if packets are damaged.
bool save_voices(const ExportFlags& flags, const Recording& recording) {
    exporting::VoicesSummary voices;
    const auto files = exporting::export_voices(recording, flags.voices, flags.overwrite, voices);
    for (std::size_t i = 0; i < files.size(); ++i)
        if (flags.json)
            std::cout << files::json_text({{"format", "voice"},
                                           {"path", files[i].string()},
                                           {"name", voices.people[i].name},
                                           {"seconds", voices.people[i].seconds},
                                           {"damaged", voices.damaged}})
                      << std::endl;
        else
            std::cout << files[i].string() << ": " << voices.people[i].name << std::endl;
    if (files.empty())
        std::cerr << "Nobody whose voice may be recorded has spoken." << std::endl;
    return voices.damaged == 0;
}

void run(const ExportFlags& flags) {
    if (flags.ply.empty() && flags.png.empty() && flags.k4a.empty() && flags.room.empty() &&
        flags.voices.empty())
        throw Error(
            "Say into what to export: --ply DIR, --png DIR, --k4a FILE.mkv, --room "
            "FILE.jsonl or --voices DIR.");
    if (flags.merged && flags.ply.empty())
        throw Error("Only points can be merged; --merged goes with --ply.");
    if (flags.undistort && flags.png.empty())
        throw Error("Only pictures can be undistorted; --undistort goes with --png.");
    if (flags.registered && flags.png.empty())
        throw Error("Only pictures can be registered; --registered goes with --png.");
    if (flags.registered && flags.undistort)
        throw Error("Pictures are exported either --undistort or --registered.");
    const bool wants_pictures = !flags.ply.empty() || !flags.png.empty() || !flags.k4a.empty();
    if (!wants_pictures && (flags.from > 0 || flags.to > 0 || flags.every > 1))
        throw Error(
            "Only pictures and points are selected; --from, --to and --every go with --ply, --png "
            "or --k4a.");
    if (flags.to > 0 && flags.to <= flags.from)
        throw Error("--to must be later than --from.");
    const Recording recording = record::RecordingFile::open(flags.file);
    cli::catch_stop_signals();
    if (flags.camera && std::size_t(*flags.camera) >= recording->cameras().size())
        throw Error("'" + flags.file + "' has no camera " + std::to_string(*flags.camera) +
                    ": it has " + std::to_string(recording->cameras().size()) +
                    ", counted from 0.");
    if (wants_pictures && recording->cameras().empty())
        throw Error("'" + flags.file +
                    "' has no pictures: no camera was there. Its room and voices are exported with "
                    "--room and --voices.");
    const std::vector<std::string> filters = filters_of(*recording, flags.camera);
    std::size_t calibrations = 1;
    for (const record::CameraContent& camera : recording->cameras())
        calibrations = std::max(calibrations, capture::calibrations_of(camera));
    bool damaged = !(recording->intact() && recording->complete());
    for (const std::string& remark : record::remarks_on_files(*recording))
        std::cerr << remark << std::endl;
    for (const record::Segment& segment : recording->segments())
        for (const std::string& remark : record::remarks_on(segment))
            std::cerr << segment.file << ": " << remark << std::endl;

    if (!flags.room.empty() && !recording->room().present)
        throw Error("'" + flags.file + "' has no room: only recordings of sessions have one.");
    if (!flags.voices.empty() && recording->voices().empty())
        throw Error(
            "'" + flags.file +
            "' has no voices: only recordings of sessions have those of people who agreed.");
    std::vector<std::filesystem::path> sources;
    for (const record::Segment& segment : recording->segments())
        sources.emplace_back(segment.file);
    for (const auto& [file, count] :
         {std::pair(flags.k4a, calibrations), std::pair(flags.room, std::size_t(1))}) {
        if (file.empty())
            continue;
        exporting::require_free(file, count, flags.overwrite, sources);
        files::require_writable(file);
    }
    for (const std::string& folder : {flags.ply, flags.png})
        if (!folder.empty())
            exporting::clear_folder(folder, flags.overwrite);

    const auto report = [&](const char* what, const Exported& e, const std::string& place) {
        if (e.count == 0 && flags.from + flags.to > 0)
            throw Error("'" + flags.file +
                        "' has no picture in the seconds that --from and --to "
                        "name; 'theatron inspect' says how long it is.");
        damaged |= e.losses.depth() + e.losses.color() > 0;
        nlohmann::json places = nlohmann::json::array();
        for (const auto& [path, count] : e.places)
            places.push_back({{"path", path.string()}, {"count", count}});
        if (flags.json)
            std::cout << files::json_text({{"format", what},
                                           {"count", e.count},
                                           {"path", place},
                                           {"places", places},
                                           {"lost_depth", e.losses.depth()},
                                           {"lost_color", e.losses.color()},
                                           {"filters", filters}})
                      << std::endl;
        else
            for (const auto& [path, count] : e.places)
                std::cout << path.string() << ": " << count << (count == 1 ? " frame" : " frames")
                          << (path == place ? "" : ", after a camera was moved or adjusted")
                          << std::endl;
        if (e.losses.depth() + e.losses.color() > 0)
            std::cerr << "of depth " << e.losses.damaged_depth << " pictures are damaged and "
                      << e.losses.undecodable_depth << " refer to what is not there; of colour "
                      << e.losses.damaged_color << " and " << e.losses.undecodable_color
                      << "; these are left out" << std::endl;
    };
    // For each format the cameras play from their first frame to their last. After a change of its
    // calibration, a camera's pictures continue in a separate folder or file.
    const auto export_as = [&](const char* what, const std::string& place, auto write) {
        Exported exported;
        for (std::size_t n = 0; n < calibrations; ++n) {
            exporting::ExportSource source = open_source(flags, recording, n);
            if (!source.cameras.empty()) {
                const std::filesystem::path own = exporting::place_of(place, n);
                exported.add(source, own, write(source, own));
            }
        }
        report(what, exported, place);
    };
    if (!flags.json)
        for (const std::string& line : filters)
            std::cout << "depth was filtered before it was recorded: " << host::shown_filter(line)
                      << std::endl;
    if (!flags.ply.empty())
        export_as("ply", flags.ply,
                  [&](exporting::ExportSource& source, const std::filesystem::path& place) {
                      if (flags.merged)
                          say_places(source);
                      return exporting::export_ply(source, place, flags.merged);
                  });
    if (!flags.png.empty()) {
        const exporting::Pictures pictures = flags.undistort    ? exporting::Pictures::undistorted
                                             : flags.registered ? exporting::Pictures::registered
                                                                : exporting::Pictures::recorded;
        export_as("png", flags.png,
                  [&](exporting::ExportSource& source, const std::filesystem::path& place) {
                      return exporting::export_png(source, place, pictures);
                  });
    }
    if (!flags.k4a.empty()) {
        Exported exported;
        exporting::replace_files(
            flags.k4a, calibrations, [&](const std::filesystem::path& draft, std::size_t n) {
                exporting::ExportSource source = open_source(flags, recording, n);
                if (!source.cameras.empty())
                    exported.add(source, exporting::place_of(flags.k4a, n),
                                 exporting::export_k4a(source, draft));
            });
        report("k4a", exported, flags.k4a);
    }
    if (!flags.room.empty()) {
        capture::RecordedRoom::Figures figures;
        std::size_t lines = 0;
        exporting::replace_files(flags.room, 1,
                                 [&](const std::filesystem::path& draft, std::size_t) {
                                     lines = exporting::export_room(recording, draft, figures);
                                 });
        damaged |= figures.damaged + figures.undecodable > 0;
        if (flags.json)
            std::cout << files::json_text({{"format", "room"},
                                           {"count", lines},
                                           {"path", flags.room},
                                           {"damaged", figures.damaged},
                                           {"undecodable", figures.undecodable}})
                      << std::endl;
        else
            std::cout << flags.room << ": " << lines << " moments" << std::endl;
    }
    if (!flags.voices.empty())
        damaged |= !save_voices(flags, recording);
    if (!damaged)
        return;
    std::cerr << "Parts of the recording are damaged or missing; what is whole was exported. "
                 "'theatron inspect --verify' says more."
              << std::endl;
    throw CLI::RuntimeError(damaged_exit_code);
}

}  // namespace

void add_export_command(CLI::App& app) {
    const auto flags = std::make_shared<ExportFlags>();
    CLI::App* command = app.add_subcommand("export", "Turn a recording into points or pictures");
    command->footer(
        "Depth is exported as it was recorded, without loss. With several cameras, each gets a\n"
        "folder of its own: DIR/camera-0 and so on. Where a camera was moved or adjusted, its "
        "later\n"
        "pictures are in DIR.2 and so on, which have another calibration. From a damaged "
        "recording\n"
        "all that is whole is exported, and the exit code is 3.\n"
        "\nExamples:\n"
        "  theatron export operation.mkv --ply points --merged\n"
        "  theatron export operation.mkv --png pictures --camera 1\n"
        "  theatron export operation.mkv --png for_others --undistort\n"
        "  theatron export operation.mkv --ply points --from 60 --to 70 --every 30\n"
        "  theatron export operation.mkv --png rgbd --registered\n"
        "  theatron export operation.mkv --room room.jsonl\n"
        "  theatron export operation.mkv --voices said\n"
        "  theatron host --camera folder:pictures,loop=1\n"
        "  theatron export operation.mkv --camera 0 --k4a kinect.mkv");
    command->add_option("file", flags->file, "The recording")->required();
    command->add_option("--ply", flags->ply, "Write points, a PLY file a frame, into this folder");
    command->add_flag("--merged", flags->merged,
                      "With --ply: all cameras' points of a moment in one file, in the room");
    command->add_option("--png", flags->png,
                        "Write depth and colour pictures into this folder, as folder:DIR reads "
                        "them");
    command->add_flag("--undistort", flags->undistort,
                      "With --png: pictures as lenses without distortion would give them, for "
                      "programs that know no other; each depth pixel is the nearest one");
    command->add_flag("--registered", flags->registered,
                      "With --png: the colour of each depth pixel, black where the colour camera "
                      "does not see it");
    command->add_option("--k4a", flags->k4a,
                        "Write a file like an Azure Kinect's, as mkv:FILE reads it");
    command->add_option("--room", flags->room,
                        "Write people, objects and poses into this file, a JSON line for each "
                        "moment at which something changed");
    command->add_option("--voices", flags->voices,
                        "Write what each person said into this folder, a WAV file for each; all "
                        "begin with the recording's first picture");
    command->add_option("--camera", flags->camera, "Only this camera, counted from 0")
        ->check(CLI::Range(0, 62));
    constexpr double longest = 1e6;
    command->add_option("--from", flags->from, "Only frames from this second of the recording on")
        ->check(cli::number_from_to(0.0, longest));
    command->add_option("--to", flags->to, "Only frames before this second of the recording")
        ->check(cli::number_from_to(0.001, longest));
    command
        ->add_option("--every", flags->every,
                     "Only the first of these frames and then each of this count")
        ->check(CLI::Range(1, 1'000'000));
    command->add_flag("--overwrite", flags->overwrite,
                      "Replace an export that is there; other files in its folders stay");
    command->add_flag("--json", flags->json, "Print what was written as JSON lines");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
