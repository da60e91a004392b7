// SPDX-License-Identifier: Apache-2.0
// theatron recover
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/progress.h"
#include "cli/stop_signal.h"
#include "commands.h"
#include "record/recover.h"
#include "record/remarks.h"

namespace theatron::app {
namespace {

using Json = nlohmann::ordered_json;

struct RecoverFlags {
    std::string file, out;
    bool json = false;
};

// "operation.recovered.mkv" beside "operation.mkv".
std::string default_out(const std::filesystem::path& file) {
    std::filesystem::path name = file.stem();
    name += ".recovered";
    name += file.extension();
    return (file.parent_path() / name).string();
}

void print(const record::RecordingFile& recording, const record::Recovered& saved,
           const Json& cameras, std::uint64_t repeated) {
    for (const Json& camera : cameras)
        for (const char* kind : {"depth", "color"}) {
            const Json& s = camera[kind];
            if (s["saved"] > 0 || s["damaged"] > 0 || s["undecodable"] > 0)
                std::printf(
                    "camera %d, %s: %llu pictures saved; %llu damaged and %llu that refer to what "
                    "is not there were left out\n",
                    int(camera["camera"]), std::string(kind) == "depth" ? "depth" : "colour",
                    (unsigned long long)s["saved"], (unsigned long long)s["damaged"],
                    (unsigned long long)s["undecodable"]);
        }
    if (const record::RecoveredStream& voices = saved.voices; voices.saved + voices.damaged > 0)
        std::printf("voices: %llu packets saved; %llu damaged ones were left out\n",
                    (unsigned long long)voices.saved, (unsigned long long)voices.damaged);
    if (const record::RecoveredStream& room = saved.room; room.saved + room.damaged > 0)
        std::printf(
            "room: %llu parts saved; %llu damaged and %llu that refer to them were left out\n",
            (unsigned long long)room.saved, (unsigned long long)room.damaged,
            (unsigned long long)room.undecodable);
    if (repeated > 0)
        std::printf("%llu pictures stood in it twice, and are saved once\n",
                    (unsigned long long)repeated);
    for (const record::Segment& segment : recording.segments())
        for (const std::string& remark : record::remarks_on(segment))
            std::printf("%s: %s\n", segment.file.c_str(), remark.c_str());
    for (const std::string& remark : record::remarks_on_files(recording))
        std::printf("%s\n", remark.c_str());
    for (const std::string& file : saved.files)
        std::printf("%s\n", file.c_str());
}

void run(const RecoverFlags& flags) {
    const auto recording = record::RecordingFile::open(flags.file);
    cli::catch_stop_signals();
    const capture::Progress show = cli::show_progress();
    const record::Recovered saved = record::recover(
        *recording, flags.out.empty() ? default_out(flags.file) : flags.out, [&](double done) {
            if (cli::stop_requested())
                throw Error("Stopped before it was whole; no file was written.");
            if (show)
                show("recovering", done);
        });
    Json cameras = Json::array();
    const auto describe = [](const record::RecoveredStream& s) {
        return Json{{"saved", s.saved}, {"damaged", s.damaged}, {"undecodable", s.undecodable}};
    };
    for (std::size_t i = 0; i < saved.cameras.size(); ++i) {
        cameras.push_back({{"camera", int(recording->cameras()[i].id)},
                           {"depth", describe(saved.cameras[i].depth)},
                           {"color", describe(saved.cameras[i].color)}});
    }
    std::uint64_t places = 0, repeated = 0;
    record::SegmentChain::Foreign foreign;
    for (const auto& camera : saved.cameras)
        repeated += camera.depth.repeated + camera.color.repeated;
    for (const record::Segment& segment : recording->segments()) {
        places += segment.damaged_places + segment.head_damaged;
        repeated += segment.repeated;
        foreign.add(segment.foreign);
    }
    Json ends = Json::array();
    for (const record::Segment& segment : recording->segments())
        if (!segment.closed)
            ends.push_back(
                {{"file", segment.file},
                 {"missing_seconds",
                  segment.missing_end ? Json(to_seconds(*segment.missing_end)) : Json()}});
    if (flags.json)
        std::cout << Json{{"files", saved.files},
                          {"complete", saved.complete},
                          {"bytes", saved.bytes},
                          {"damaged_places", places},
                          {"missing_segments", recording->missing_segments()},
                          {"unreadable_files", recording->unreadable_files()},
                          {"repeated", repeated},
                          {"foreign_files", foreign.files},
                          {"foreign_bytes", foreign.bytes},
                          {"missing_ends", ends},
                          {"cameras", cameras},
                          {"voices", describe(saved.voices)},
                          {"room", describe(saved.room)}}
                         .dump(-1, ' ', false, Json::error_handler_t::replace)
                  << std::endl;
    else
        print(*recording, saved, cameras, repeated);
    if (!saved.complete)
        throw CLI::RuntimeError(damaged_exit_code);
}

}  // namespace

void add_recover_command(CLI::App& app) {
    const auto flags = std::make_shared<RecoverFlags>();
    CLI::App* command =
        app.add_subcommand("recover", "Write what is whole of a damaged recording into a new one");
    command->footer(
        "Pictures that are damaged, and those that cannot be decoded without them, are left out;\n"
        "all others are copied as they are. The recording itself is not changed. Exit code 0: "
        "all\n"
        "of it was saved; 3: something was left out or is missing, which the new file says, too; "
        "1: nothing was\n"
        "written.\n"
        "\nExamples:\n"
        "  theatron recover operation.mkv\n"
        "  theatron recover operation.mkv saved.mkv");
    command->add_option("file", flags->file, "The recording")->required();
    command->add_option("out", flags->out,
                        "The file to write; not given: FILE with '.recovered' in its name");
    command->add_flag("--json", flags->json, "Print what was saved as JSON");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
