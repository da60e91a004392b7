// SPDX-License-Identifier: Apache-2.0
// theatron inspect
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/progress.h"
#include "commands.h"
#include "export/room_of_recording.h"
#include "export/verify_recording.h"
#include "export/voices_of_recording.h"
#include "geometry/calibration.h"
#include "host/filter_choice.h"
#include "record/recording_file.h"
#include "record/remarks.h"

namespace theatron::app {
namespace {

using Json = nlohmann::ordered_json;

// Figures of a recorded stream: rate, missing frames and gaps.
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
        const record::RecordedFrame& frame = stream.frames[i];
        f.bytes += frame.payload_size;
        f.key_frames += frame.key;
        f.filtered += frame.filtered;
        if (i == 0)
            continue;
        const record::RecordedFrame& before = stream.frames[i - 1];
        f.missing += exporting::frames_between(before, frame);
        const double pause_ms = to_ms(frame.time() - before.time());
        f.gaps += pause_ms > 1500 / nominal_fps;
        f.longest_gap_ms = std::max(f.longest_gap_ms, pause_ms);
    }
    if (stream.frames.size() > 1) {
        f.seconds = to_seconds(stream.frames.back().time() - stream.frames.front().time());
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
            {"damaged", stream.damaged},
            {"gaps", f.gaps},
            {"longest_gap_ms", f.longest_gap_ms}};
}

// The filters that were applied to depth, each with the frame and time of its beginning.
Json describe_filters(const record::StreamContent& depth) {
    Json list = Json::array();
    for (const record::FilterChange& change : depth.filters) {
        const Duration begin = depth.frames.front().time();
        const Duration at = depth.frames[change.frame].time();
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
    if (calibration->depth.size == Size{})
        return {{"problem", "without depth"}};
    Json json{{"depth", describe(calibration->depth)},
              {"depth_unit_mm", calibration->depth_unit_mm},
              {"registered", calibration->registered}};
    if (calibration->color.size != Size{}) {
        json["color"] = describe(calibration->color);
        json["baseline_mm"] = length(calibration->color_from_depth.translation) * 1000;
    }
    if (calibration->person != 0)
        json["person"] = calibration->person;
    if (calibration->depth_offset_mm)
        json["depth_offset_mm"] = *calibration->depth_offset_mm;
    if (const auto& gain = calibration->color_gain)
        json["color_gain"] = {gain->x, gain->y, gain->z};
    return json;
}

// Those of successive segments, without repetitions.
Json describe_calibrations(const record::CameraContent& camera) {
    Json list = Json::array();
    const Bytes* before = nullptr;
    for (const record::CameraPart& part : camera.parts)
        if (!before || *before != part.calibration) {
            before = &part.calibration;
            list.push_back(describe_calibration(part.calibration));
        }
    return list;
}

Json describe_lacks(const record::Segment& segment) {
    Json list = Json::array();
    for (const record::Lack lack : segment.lacks)
        list.push_back(record::text_of(lack));
    return list;
}

Json describe_segments(const record::RecordingFile& recording) {
    Json list = Json::array();
    for (const record::Segment& segment : recording.segments()) {
        list.push_back({{"file", segment.file},
                        {"version", segment.has_info ? 2 : 1},
                        {"number", segment.info.number},
                        {"begin_utc", utc_text(segment.begin_utc)},
                        {"begin_seconds", to_seconds(segment.begin)},
                        {"end_seconds", to_seconds(segment.end)},
                        {"pictures", segment.frames},
                        {"closed", segment.closed},
                        {"missing_end_seconds",
                         segment.missing_end ? Json(to_seconds(*segment.missing_end)) : Json()},
                        {"early_end", segment.early_end},
                        {"lacks", describe_lacks(segment)},
                        {"recovered", segment.recovered},
                        {"head_damaged", segment.head_damaged},
                        {"damaged_places", segment.damaged_places},
                        {"damaged_bytes", segment.damaged_bytes},
                        {"repeated", segment.repeated},
                        {"foreign_files", segment.foreign.files},
                        {"foreign_bytes", segment.foreign.bytes},
                        {"unread_end_bytes", segment.unread_end}});
        if (segment.foreign.files > 0)
            list.back()["foreign_at"] = segment.foreign.first_at;
    }
    return list;
}

Json describe_room(const record::StreamContent& room) {
    std::uint64_t bytes = 0;
    for (const record::RecordedFrame& part : room.frames)
        bytes += part.payload_size;
    return {{"parts", room.frames.size()},
            {"bytes", bytes},
            {"seconds", room.frames.empty()
                            ? 0
                            : to_seconds(room.frames.back().time() - room.frames.front().time())}};
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
        json["calibrations"] = describe_calibrations(camera);
        cameras.push_back(std::move(json));
    }
    Json json{{"file", file},
              {"bytes", recording.bytes()},
              {"seconds", to_seconds(recording.duration())},
              {"complete", recording.complete()},
              {"refused", recording.refused()},
              {"missing_segments", recording.missing_segments()},
              {"unreadable_files", recording.unreadable_files()},
              {"foreign_files_beside", recording.foreign_files()},
              {"begins_in", recording.begins_in()},
              {"segments", describe_segments(recording)},
              {"cameras", cameras}};
    if (recording.room().present)
        json["room"] = describe_room(recording.room());
    return json;
}

// Decodes all voices. True if nothing of them is damaged.
bool add_voices(const std::shared_ptr<const record::RecordingFile>& recording, Json& json) {
    const exporting::VoicesSummary voices = exporting::summarize_voices(recording);
    Json people = Json::array();
    for (const exporting::RecordedPerson& person : voices.people)
        people.push_back({{"participant", std::uint32_t(person.id)},
                          {"name", person.name},
                          {"packets", person.packets},
                          {"seconds", person.seconds}});
    json["voices"] = {{"tracks", recording->voices().size()},
                      {"packets", voices.blocks},
                      {"bytes", voices.bytes},
                      {"damaged", voices.damaged},
                      {"people", std::move(people)}};
    return voices.damaged == 0;
}

// Reads the whole track of the room. True if nothing of it is damaged.
bool add_room(const std::shared_ptr<const record::RecordingFile>& recording, Json& json) {
    const exporting::RoomSummary room = exporting::summarize_room(recording);
    json["people"] = room.people;
    json["objects"] = room.objects;
    json["changes"] = room.figures.changes;
    json["damaged"] = recording->room().damaged + room.figures.damaged;
    json["undecodable"] = room.figures.undecodable;
    return json["damaged"] == 0 && json["undecodable"] == 0;
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

// Lossless coding of filtered depth does not give the sensor's values.
void print_filtering(const Json& depth) {
    if (depth["filtered"] > 0)
        print("          %llu of them went through the host's filters\n",
              (unsigned long long)depth["filtered"]);
    for (const Json& change : depth["filters"]) {
        const std::string filters = change["filters"];
        print("          from %.1f s on: %s\n", double(change["from_seconds"]),
              filters.empty() ? "no filters" : host::shown_filter(filters).c_str());
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
    if (calibration.contains("color_gain")) {
        const Json& gain = calibration["color_gain"];
        print("  colours red times %.2f, green %.2f, blue %.2f\n", double(gain[0]), double(gain[1]),
              double(gain[2]));
    }
}

void print_segments(const record::RecordingFile& recording) {
    const std::uint32_t first = recording.segments().front().info.number;
    const bool many =
        recording.segments().size() > 1 || recording.missing_segments() > 0 || first > 1;
    for (const record::Segment& segment : recording.segments()) {
        const std::string begin = utc_text(segment.begin_utc);
        if (many)
            print("segment %u: %s, from %.1f s on%s%s\n", unsigned(segment.info.number),
                  segment.file.c_str(), to_seconds(segment.begin), begin.empty() ? "" : ", at ",
                  begin.c_str());
        else if (!begin.empty())
            print("recorded at %s\n", begin.c_str());
        for (const std::string& remark : record::remarks_on(segment))
            print("  %s\n", remark.c_str());
        if (!segment.recovered.empty())
            print("  recovered from a recording of which this was said: %s\n",
                  segment.recovered.c_str());
    }
    for (const std::string& remark : record::remarks_on_files(recording))
        print("%s\n", remark.c_str());
}

void print_minutes(const Json& camera) {
    for (const Json& minute : camera["minutes"])
        for (const char* kind : {"depth", "color"}) {
            const Json& f = minute[kind];
            if (f["damaged"] > 0 || f["undecodable"] > 0 || f["missing"] > 0)
                print(
                    "  minute %d: %s %llu pictures, %llu damaged, %llu that refer to them, %llu "
                    "missing, %llu pauses\n",
                    int(minute["minute"]), std::string(kind) == "depth" ? "depth" : "colour",
                    (unsigned long long)f["pictures"], (unsigned long long)f["damaged"],
                    (unsigned long long)f["undecodable"], (unsigned long long)f["missing"],
                    (unsigned long long)f["gaps"]);
        }
}

void print_room(const Json& room) {
    std::string names;
    for (const Json& name : room["people"])
        names += (names.empty() ? "" : ", ") + std::string(name);
    const double seconds = room["seconds"];
    print("room: %s; %llu objects, %llu changes, %.1f kB, %.2f kB/s\n",
          names.empty() ? "nobody" : names.c_str(), (unsigned long long)room["objects"],
          (unsigned long long)room["changes"], double(room["bytes"]) * 1e-3,
          seconds > 0 ? double(room["bytes"]) * 1e-3 / seconds : 0.0);
    if (room["damaged"] > 0 || room["undecodable"] > 0)
        print("  %llu of its parts are damaged, and %llu refer to missing ones\n",
              (unsigned long long)room["damaged"], (unsigned long long)room["undecodable"]);
}

void print_voices(const Json& voices) {
    for (const Json& person : voices["people"])
        print("voice of %s: %.1f s\n", std::string(person["name"]).c_str(),
              double(person["seconds"]));
    if (voices["people"].empty())
        print("no voice\n");
    if (voices["damaged"] > 0)
        print("  %llu packets of voices are damaged\n", (unsigned long long)voices["damaged"]);
}

// Decodes everything.
exporting::Verification add_verification(
    const std::shared_ptr<const record::RecordingFile>& recording, const std::string& file,
    Json& json) {
    const exporting::Verification found = exporting::verify(recording, file, cli::show_progress());
    for (std::size_t i = 0; i < found.cameras.size(); ++i) {
        Json minutes = Json::array();
        const auto describe_minute = [](const exporting::VerifiedPictures& p) {
            return Json{{"pictures", p.pictures},
                        {"damaged", p.damaged},
                        {"undecodable", p.undecodable},
                        {"missing", p.missing},
                        {"gaps", p.gaps}};
        };
        for (const auto& [minute, pictures] : found.cameras[i])
            minutes.push_back({{"minute", minute},
                               {"depth", describe_minute(pictures.depth)},
                               {"color", describe_minute(pictures.color)}});
        json["cameras"][i]["minutes"] = std::move(minutes);
    }
    json["damaged"] = found.damaged;
    return found;
}

bool ends_early(const record::RecordingFile& recording) {
    return std::any_of(recording.segments().begin(), recording.segments().end(),
                       [](const record::Segment& s) { return !s.early_end.empty(); });
}

// As its recorder noted.
bool lacks_something(const record::RecordingFile& recording) {
    return std::any_of(recording.segments().begin(), recording.segments().end(),
                       [](const record::Segment& s) { return !s.lacks.empty(); });
}

// Pictures that never came into the recording, by the numbers of those that did. Where colour
// refers to earlier colour, a picture without one takes a number, too.
std::uint64_t missing_in(const Json& cameras) {
    std::uint64_t missing = 0;
    for (const Json& camera : cameras)
        for (const char* kind : {"depth", "color"})
            if (camera.contains(kind) &&
                (std::string(kind) == "depth" || std::string(camera[kind]["codec"]) == "jpeg"))
                missing += std::uint64_t(camera[kind]["missing"]);
    return missing;
}

// The last line of --verify.
std::string verdict(const record::RecordingFile& recording, const exporting::Verification& found,
                    std::uint64_t missing) {
    if (found.damaged_pictures)
        return "parts are damaged; 'theatron recover' saves the others";
    const std::string decoded = "every picture that is there was decoded, and ";
    if (recording.missing_segments() > 0)
        return decoded + "a segment is missing";
    if (std::any_of(recording.segments().begin(), recording.segments().end(),
                    [](const record::Segment& s) { return !s.closed; }))
        return decoded + "an end is missing";
    if (ends_early(recording))
        return decoded + "it ends earlier than was wanted";
    if (lacks_something(recording))
        return decoded +
               (missing > 0 ? std::to_string(missing) + (missing == 1 ? " picture" : " pictures") +
                                  " never came into it; "
                            : "") +
               "it is not complete, as its recorder noted";
    if (!recording.complete())
        return "every picture was decoded, but a file is not as it was recorded";
    if (missing > 0)
        return decoded + "nothing is damaged; " + std::to_string(missing) +
               (missing == 1 ? " picture" : " pictures") + " never came into it";
    return "every picture was decoded, and nothing is damaged";
}

void run(const std::string& file, bool as_json, bool verified) {
    const std::shared_ptr<const record::RecordingFile> recording =
        record::RecordingFile::open(file);
    Json json = describe(file, *recording);
    const bool room_is_whole = !json.contains("room") || add_room(recording, json["room"]);
    const bool voices_are_whole = recording->voices().empty() || add_voices(recording, json);
    exporting::Verification found;
    if (verified)
        found = add_verification(recording, file, json);
    found.damaged_pictures |= verified && !(room_is_whole && voices_are_whole);
    found.damaged |= found.damaged_pictures;
    if (as_json)
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
    else {
        print("%s: %.1f s, %.1f MB, %zu camera(s)\n", file.c_str(), double(json["seconds"]),
              double(json["bytes"]) * 1e-6, recording->cameras().size());
        print_segments(*recording);
        for (const Json& camera : json["cameras"]) {
            print("camera %d: %s\n", int(camera["camera"]), std::string(camera["name"]).c_str());
            print_stream("depth", camera["depth"]);
            print_filtering(camera["depth"]);
            if (camera.contains("color"))
                print_stream("colour", camera["color"]);
            print_calibration(camera["calibrations"].back());
            if (verified)
                print_minutes(camera);
        }
        if (json.contains("room"))
            print_room(json["room"]);
        if (json.contains("voices"))
            print_voices(json["voices"]);
        if (verified)
            print("%s\n", verdict(*recording, found, missing_in(json["cameras"])).c_str());
    }
    if (verified && (found.damaged || !recording->complete()))
        throw CLI::RuntimeError(damaged_exit_code);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
    struct Flags {
        std::string file;
        bool json = false;
        bool verify = false;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = app.add_subcommand("inspect", "Tell what a recording holds");
    command->footer(
        "A recording that goes on in further files (operation.002.mkv ...) is one: name the "
        "first.\n"
        "With --verify the exit code is 3 if anything is damaged, an end is missing or came too "
        "early,\nor the recorder noted that the recording is not complete.\n"
        "\nExamples:\n"
        "  theatron inspect operation.mkv\n"
        "  theatron inspect operation.mkv --json\n"
        "  theatron inspect operation.mkv --verify");
    command->add_option("file", flags->file, "The recording")->required();
    command->add_flag("--json", flags->json, "Print JSON");
    command->add_flag("--verify", flags->verify,
                      "Decode every picture, and tell what is damaged or missing minute by minute");
    command->callback([flags] { run(flags->file, flags->json, flags->verify); });
}

}  // namespace theatron::app
