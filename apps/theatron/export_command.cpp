// SPDX-License-Identifier: Apache-2.0
// theatron export
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "commands.h"
#include "export_formats.h"
#include "filter_choice.h"
#include "json_text.h"
#include "progress.h"

namespace theatron::app {
namespace {

struct Flags {
    std::string file;
    std::string ply, png, k4a;
    std::optional<int> camera;
    bool merged = false;
    bool undistort = false;
    bool registered = false;
    bool json = false;
};

using Recording = std::shared_ptr<const record::RecordingFile>;

ExportSource open_source(const Flags& flags, const Recording& recording) {
    ExportSource source;
    source.progress = show_progress();
    if (flags.camera) {
        source.cameras.push_back(std::make_unique<capture::RecordedFrames>(
            recording, std::size_t(*flags.camera), flags.file));
        return source;
    }
    for (std::size_t i = 0; i < recording->cameras().size(); ++i)
        source.cameras.push_back(
            std::make_unique<capture::RecordedFrames>(recording, i, flags.file));
    return source;
}

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

void run(const Flags& flags) {
    if (flags.ply.empty() && flags.png.empty() && flags.k4a.empty())
        throw Error("Say into what to export: --ply DIR, --png DIR or --k4a FILE.mkv.");
    if (flags.merged && flags.ply.empty())
        throw Error("Only points can be merged; --merged goes with --ply.");
    if (flags.undistort && flags.png.empty())
        throw Error("Only pictures can be undistorted; --undistort goes with --png.");
    if (flags.registered && flags.png.empty())
        throw Error("Only pictures can be registered; --registered goes with --png.");
    if (flags.registered && flags.undistort)
        throw Error("Pictures are exported either --undistort or --registered.");
    const Recording recording = record::RecordingFile::open(flags.file);
    const std::vector<std::string> filters = filters_of(*recording, flags.camera);
    const auto report = [&](const char* what, std::size_t count, const std::string& place) {
        if (flags.json)
            std::cout << json_text({{"format", what},
                                    {"count", count},
                                    {"path", place},
                                    {"filters", filters}})
                      << std::endl;
        else
            std::cout << place << ": " << count << (count == 1 ? " frame" : " frames") << std::endl;
    };
    if (!flags.json)
        for (const std::string& line : filters)
            std::cout << "depth was filtered before it was recorded: " << shown_filter(line)
                      << std::endl;
    // Each begins anew: a camera plays from its first frame to its last.
    if (!flags.ply.empty()) {
        ExportSource source = open_source(flags, recording);
        report("ply", export_ply(source, flags.ply, flags.merged), flags.ply);
    }
    if (!flags.png.empty()) {
        const Pictures pictures = flags.undistort    ? Pictures::undistorted
                                  : flags.registered ? Pictures::registered
                                                     : Pictures::recorded;
        ExportSource source = open_source(flags, recording);
        report("png", export_png(source, flags.png, pictures), flags.png);
    }
    if (!flags.k4a.empty()) {
        ExportSource source = open_source(flags, recording);
        report("k4a", export_k4a(source, flags.k4a), flags.k4a);
    }
}

}  // namespace

void add_export_command(CLI::App& app) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("export", "Turn a recording into points or pictures");
    command->footer(
        "Depth is exported as it was recorded, without loss. Of several cameras, each gets a\n"
        "folder of its own: DIR/camera-0 and so on.\n"
        "\nExamples:\n"
        "  theatron export operation.mkv --ply points --merged\n"
        "  theatron export operation.mkv --png pictures --camera 1\n"
        "  theatron export operation.mkv --png for_others --undistort\n"
        "  theatron export operation.mkv --png rgbd --registered\n"
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
    command->add_option("--camera", flags->camera, "Only this camera, counted from 0")
        ->check(CLI::Range(0, 62));
    command->add_flag("--json", flags->json, "Print what was written as JSON lines");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
