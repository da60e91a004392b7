// SPDX-License-Identifier: Apache-2.0
// theatron inspect
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "filter_choice.h"
#include "geometry/calibration.h"
#include "record/recording_file.h"

namespace theatron::app {
namespace {

using Json = nlohmann::ordered_json;

// What of a stream is missing and how even it came.
struct Figures {
    double seconds = 0;
    double frames_per_second = 0;
    std::uint64_t bytes = 0;
    std::uint64_t key_frames = 0;
    std::uint64_t filtered = 0;  // frames that went through filters before they were encoded
    std::uint64_t missing = 0;   // frames that were made but not recorded
    std::uint64_t gaps = 0;      // pauses of more than one and a half periods
    double longest_gap_ms = 0;
};

Figures figures_of(const record::StreamContent& stream, double nominal_fps) {
    Figures f;
    for (std::size_t i = 0; i < stream.frames.size(); ++i) {
        const wire::MediaHeader& header = stream.frames[i].header;
        f.bytes += header.payload_size;
        f.key_frames += header.key;
        f.filtered += header.filtered != TimePoint{};
        if (i == 0)
            continue;
        const wire::MediaHeader& before = stream.frames[i - 1].header;
        if (const auto step = std::int32_t(header.frame - before.frame); step > 1)
            f.missing += std::uint64_t(step - 1);
        const double pause_ms = to_ms(header.captured - before.captured);
        f.gaps += pause_ms > 1500 / nominal_fps;
        f.longest_gap_ms = std::max(f.longest_gap_ms, pause_ms);
    }
    if (stream.frames.size() > 1) {
        f.seconds = to_seconds(stream.frames.back().header.captured -
                               stream.frames.front().header.captured);
        if (f.seconds > 0)
            f.frames_per_second = double(stream.frames.size() - 1) / f.seconds;
    }
    return f;
}

Json describe(const record::StreamContent& stream, double nominal_fps) {
    const Figures f = figures_of(stream, nominal_fps);
    return {{"codec", stream.codec},
            {"width", stream.width},
            {"height", stream.height},
            {"frames", stream.frames.size()},
            {"key_frames", f.key_frames},
            {"filtered", f.filtered},
            {"bytes", f.bytes},
            {"seconds", f.seconds},
            {"fps", f.frames_per_second},
            {"missing", f.missing},
            {"gaps", f.gaps},
            {"longest_gap_ms", f.longest_gap_ms}};
}

// Which filters depth went through, and from when on.
Json describe_filters(const record::StreamContent& depth) {
    Json list = Json::array();
    for (const record::FilterChange& change : depth.filters) {
        const TimePoint begin = depth.frames.front().header.captured;
        const TimePoint at = depth.frames[change.frame].header.captured;
        list.push_back({{"from_frame", change.frame},
                        {"from_seconds", to_seconds(at - begin)},
                        {"filters", change.filters}});
    }
    return list;
}

Json describe(const CameraModel& model) {
    return {{"fx", model.fx},
            {"fy", model.fy},
            {"cx", model.cx},
            {"cy", model.cy},
            {"horizontal_fov_degrees",
             2 * std::atan(model.size.width / (2 * model.fx)) * 180 / 3.14159265358979}};
}

Json describe_calibration(const Bytes& bytes) {
    const auto calibration = decode_calibration(bytes);
    if (!calibration)
        return {{"problem", to_text(calibration.error())}};
    Json json{{"depth", describe(calibration->depth)},
              {"depth_unit_mm", calibration->depth_unit_mm},
              {"registered", calibration->registered}};
    if (calibration->color.size != Size{}) {
        json["color"] = describe(calibration->color);
        json["baseline_mm"] = length(calibration->color_from_depth.translation) * 1000;
    }
    return json;
}

Json describe(const std::string& file, const record::RecordingFile& recording) {
    Json cameras = Json::array();
    for (const record::CameraContent& camera : recording.cameras()) {
        Json json{{"camera", int(camera.id)},
                  {"name", camera.name},
                  {"nominal_fps", camera.frames_per_second},
                  {"depth", describe(camera.depth, camera.frames_per_second)}};
        json["depth"]["filters"] = describe_filters(camera.depth);
        if (camera.color.present)
            json["color"] = describe(camera.color, camera.frames_per_second);
        json["calibration"] = describe_calibration(camera.calibration);
        cameras.push_back(std::move(json));
    }
    return {{"file", file},
            {"bytes", recording.bytes()},
            {"seconds", to_seconds(recording.end() - recording.begin())},
            {"complete", recording.complete()},
            {"refused", recording.refused()},
            {"cameras", cameras}};
}

template <class... Args>
void print(const char* format, Args... args) {
    std::printf(format, args...);
}

void print_stream(const char* what, const Json& stream) {
    const double seconds = stream["seconds"];
    print("  %-7s %dx%d  %s  %llu pictures, %.2f fps, %.1f MB, %.1f Mbit/s\n", what,
          int(stream["width"]), int(stream["height"]), std::string(stream["codec"]).c_str(),
          (unsigned long long)stream["frames"], double(stream["fps"]),
          double(stream["bytes"]) * 1e-6,
          seconds > 0 ? double(stream["bytes"]) * 8e-6 / seconds : 0.0);
    if (stream["missing"] > 0 || stream["gaps"] > 0)
        print("          %llu missing, %llu pauses, the longest %.0f ms\n",
              (unsigned long long)stream["missing"], (unsigned long long)stream["gaps"],
              double(stream["longest_gap_ms"]));
}

// Lossless coding of what was filtered before is not what the sensor gave.
void print_filtering(const Json& depth) {
    if (depth["filtered"] > 0)
        print("          %llu of them went through the host's filters\n",
              (unsigned long long)depth["filtered"]);
    for (const Json& change : depth["filters"]) {
        const std::string filters = change["filters"];
        print("          from %.1f s on: %s\n", double(change["from_seconds"]),
              filters.empty() ? "no filters" : shown_filter(filters).c_str());
    }
}

void print_calibration(const Json& calibration) {
    if (calibration.contains("problem")) {
        print("  calibration is %s\n", std::string(calibration["problem"]).c_str());
        return;
    }
    print("  lenses  depth %.0f degrees wide",
          double(calibration["depth"]["horizontal_fov_degrees"]));
    if (calibration.contains("color"))
        print(", colour %.0f, %.0f mm apart",
              double(calibration["color"]["horizontal_fov_degrees"]),
              double(calibration["baseline_mm"]));
    print("; %g mm a step; %s\n", double(calibration["depth_unit_mm"]),
          calibration["registered"] ? "its place in the room is known" : "not registered");
}

void run(const std::string& file, bool as_json) {
    const auto recording = record::RecordingFile::open(file);
    const Json json = describe(file, *recording);
    if (as_json) {
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
        return;
    }
    print("%s: %.1f s, %.1f MB, %zu camera(s)%s\n", file.c_str(), double(json["seconds"]),
          double(json["bytes"]) * 1e-6, recording->cameras().size(),
          recording->complete() ? "" : "; it was cut short, and opens up to the last whole part");
    if (recording->refused() > 0)
        print("%llu pictures are damaged and left out\n", (unsigned long long)recording->refused());
    for (const Json& camera : json["cameras"]) {
        print("camera %d: %s\n", int(camera["camera"]), std::string(camera["name"]).c_str());
        print_stream("depth", camera["depth"]);
        print_filtering(camera["depth"]);
        if (camera.contains("color"))
            print_stream("colour", camera["color"]);
        print_calibration(camera["calibration"]);
    }
}

}  // namespace

void add_inspect_command(CLI::App& app) {
    struct Flags {
        std::string file;
        bool json = false;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("inspect", "Tell what a recording holds");
    command->footer(
        "Examples:\n"
        "  theatron inspect operation.mkv\n"
        "  theatron inspect operation.mkv --json");
    command->add_option("file", flags->file, "The recording")->required();
    command->add_flag("--json", flags->json, "Print JSON");
    command->callback([flags] { run(flags->file, flags->json); });
}

}  // namespace theatron::app
