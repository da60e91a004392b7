// SPDX-License-Identifier: Apache-2.0
#include "table1_measure.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"
#include "bench_color.h"
#include "bench_depth.h"
#include "bench_filter.h"
#include "bench_interaction.h"
#include "camera_frames.h"
#include "child_process.h"
#include "table1_inputs.h"
#include "temporary_folder.h"
#include "this_machine.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::bench {
namespace {

// Small, so that a software renderer keeps up with the camera.
constexpr const char* photon_picture = "640x360";
// The first pictures of a session are late, and software renderers draw few.
constexpr double begin_s = 2;
constexpr const char* headset_part = "pictures for a headset";

class Measuring {
public:
    Measuring(const Table1Options& options, const capture::Progress& progress)
        : options_(options), progress_(progress) {
        timed("the input", [&] {
            for (const std::string& camera : options.cameras)
                cameras_.push_back(load_camera_frames(camera, options.frames, progress));
            describe_inputs();
        });
        out_.processor = processor_name();
        out_.cores = int(std::thread::hardware_concurrency());
        out_.runs = options.runs;
        out_.frames = int(cameras_.front().depth.size());
        out_.cores_of_others = cores_of_others();
        describe_strip();
    }

    Table1Measured run() {
        missing_encoders();
        timed(headset_part, [&] { begin_headset(); });
        for (int run = 0; run < options_.runs; ++run) {
            run_ = run;
            part(0.00, "filters", "filter", [&] { filters(); });
            part(0.05, "depth", "depth/full", [&] { depth("full", cameras_.front().depth); });
            part(0.15, "cropped depth", "depth/cropped", [&] { depth("cropped", cropped_depth_); });
            part(0.25, "colour", "color/full", [&] { color("full", color_); });
            part(0.33, "cropped colour", "color/cropped",
                 [&] { color("cropped", cropped_color_); });
            rates();
            part(0.40, headset_part, "vr", [&] { headset(); });
            part(0.70, "a session", "session/same", [&] { session("same", "trvl"); });
            part(0.85, "a session", "session/best", [&] { session("best", "strata"); });
            part(0.95, "the age of a drawn picture", "photon/inside", [&] { motion_to_photon(); });
        }
        out_.reasons["photon/filmed"] =
            "It needs a film that shows the scene's screen and the participant's display: "
            "theatron photon film.";
        return std::move(out_);
    }

private:
    void describe_inputs() {
        const CameraFrames& first = cameras_.front();
        const Size full = first.depth.front().size;
        const capture::Crop crop = paper_crop(full);
        cropped_depth_ = parts_of(first.depth, crop);
        color_ = registered_colors(first);
        cropped_color_ = parts_of(color_, crop);
        const std::string of = " of " + first.camera + ", " + std::to_string(first.depth.size()) +
                               (first.depth.size() == 1 ? " picture" : " pictures");
        const auto describe = [&](Table1Input input, const std::string& what, Size size) {
            out_.sizes[input] = size;
            out_.inputs[input] = what + ", " + size_text(size) + "," + of;
        };
        describe(Table1Input::depth_full, "depth, unfiltered", full);
        describe(Table1Input::depth_cropped, "depth, unfiltered, cropped", crop.size);
        describe(Table1Input::color_full, "colour registered to depth", full);
        describe(Table1Input::color_cropped, "colour registered to depth, cropped", crop.size);
        describe(Table1Input::both_full, "colour registered to depth, and depth", full);
        describe(Table1Input::both_cropped, "colour registered to depth, and depth, cropped",
                 crop.size);
        const std::string eyes = "; two eyes of " + size_text(options_.eye);
        const std::string second =
            cameras_.size() > 1 ? cameras_[1].camera : "once more, in the same place";
        out_.sizes[Table1Input::one_camera] = out_.sizes[Table1Input::two_cameras] = full;
        out_.inputs[Table1Input::one_camera] = "a picture of " + first.camera + eyes;
        out_.inputs[Table1Input::two_cameras] =
            "a picture of " + first.camera + " and of " + second + eyes;
        out_.inputs[Table1Input::session] =
            "a host with " + std::to_string(options_.cameras.size()) +
            (options_.cameras.size() == 1 ? " camera" : " cameras") +
            ", two participants that act, one that moves; " +
            formatted_seconds(options_.session_seconds);
    }

    void describe_strip() {
        out_.inputs[Table1Input::strip] =
            std::string(
                "a strip that shows the time, of a camera without delay, 30 pictures a "
                "second; drawn as ") +
            photon_picture;
    }

    static std::string formatted_seconds(double seconds) {
        return std::to_string(int(std::lround(seconds))) + " s a run";
    }

    // A part that cannot be measured gives its reason to all of its rows.
    template <class Work>
    void part(double done, const char* what, const std::string& key, const Work& work) {
        progress_("run " + std::to_string(run_ + 1) + ": " + what,
                  (run_ + done) / double(options_.runs));
        if (out_.reasons.contains(key))
            return;
        timed(what, [&] {
            try {
                work();
            } catch (const Error& e) {
                out_.reasons[key] = e.what();
            }
        });
    }

    // Adds the time of the work to that of its part.
    template <class Work>
    void timed(const char* what, const Work& work) {
        const TimePoint begin = steady_now();
        work();
        auto& parts = out_.part_seconds;
        auto place = std::find_if(parts.begin(), parts.end(),
                                  [&](const auto& part) { return part.first == what; });
        if (place == parts.end())
            place = parts.insert(parts.end(), {what, 0});
        place->second += to_seconds(steady_now() - begin);
    }

    void add(const std::string& key, double value) { out_.samples[key].push_back(value); }

    void missing_encoders() {
        for (const char* codec : {"h264:crf=20,encoder=x264", "h264:crf=20"}) {
            const auto setting = video::parse_color_setting(codec);
            note_missing("color", codec,
                         setting.problem.empty() ? video::missing_color_encoder(setting.setting)
                                                 : setting.problem,
                         color_codecs_);
        }
        const auto setting = video::parse_depth_setting("h264:crf=10");
        note_missing("depth", "h264:crf=10",
                     setting.problem.empty() ? video::missing_depth_encoder(setting.setting)
                                             : setting.problem,
                     depth_codecs_);
        if (color_.empty())
            out_.reasons["color"] = out_.reasons["color/full"] = out_.reasons["color/cropped"] =
                out_.reasons["rate"] = "The camera " + cameras_.front().camera + " has no colour.";
    }
    void note_missing(const std::string& kind, const std::string& codec, const std::string& missing,
                      std::vector<std::string>& codecs) {
        if (missing.empty()) {
            codecs.push_back(codec);
            return;
        }
        for (const char* part : {"/full/", "/cropped/"})
            out_.reasons[kind + part + codec + "/"] = missing;
    }

    void filters() {
        const nlohmann::json result =
            bench_filter(cameras_.front().depth, {"paper", "default"},
                         run_ == 0 ? FilterCompany::check : FilterCompany::nothing);
        for (const auto& chain : result["chain"])
            add("filter/" + chain["variant"].get<std::string>(), chain["ms"].get<double>());
        for (const auto& stage : result["stages"])
            if (stage["variant"] == "simd")
                add("filter/" + stage["name"].get<std::string>(), stage["ms"].get<double>());
    }

    void codecs(const std::string& place, const nlohmann::json& result) {
        for (const auto& codec : result["codecs"]) {
            const std::string key = place + "/" + codec["name"].get<std::string>() + "/";
            add(key + "encode_ms", codec["encode_ms"].get<double>());
            add(key + "decode_ms", codec["decode_ms"].get<double>());
            add(key + "kb", codec["bytes_mean"].get<double>() / bytes_per_kb);
            if (codec.contains("rmse_mm"))
                add(key + "rmse_mm", codec["rmse_mm"].get<double>());
        }
    }
    void depth(const std::string& size, const std::vector<DepthImage>& frames) {
        codecs("depth/" + size,
               bench_depth_sequence(size, frames, depth_codecs_, DepthYardsticks::zstd));
    }
    void color(const std::string& size, const std::vector<ColorImage>& frames) {
        codecs("color/" + size, bench_color_sequence(size, frames, color_codecs_));
    }

    // Sums of sizes of the same run.
    void rates() {
        constexpr double pictures_a_second = 30;
        const auto newest = [&](const std::string& key) -> std::optional<double> {
            const auto found = out_.samples.find(key);
            if (found == out_.samples.end() || int(found->second.size()) <= run_)
                return std::nullopt;
            return found->second.back();
        };
        for (const std::string size : {"full", "cropped"})
            for (const auto& [way, color, depth] :
                 {std::tuple{"same", "libjpeg_turbo:quality=85", "trvl"},
                  std::tuple{"best", "jpeg:quality=85", "strata"}}) {
                const auto color_kb = newest("color/" + size + "/" + color + "/kb");
                const auto depth_kb = newest("depth/" + size + "/" + depth + "/kb");
                if (color_kb && depth_kb)
                    add("rate/" + size + "/" + way, pictures_a_second * (*color_kb + *depth_kb));
                else
                    out_.reasons.try_emplace("rate",
                                             "Its colour or its depth has no figure; see there.");
            }
    }

    void begin_headset() {
        try {
            std::vector<RenderBenchCamera> cameras;
            for (std::size_t i = 0; i < 2; ++i) {
                const CameraFrames& from = cameras_[std::min(i, cameras_.size() - 1)];
                cameras.push_back({from.calibration, from.depth.front(),
                                   from.color.empty() ? ColorImage{} : from.color.front()});
            }
            headset_.emplace(std::move(cameras), options_.eye);
            out_.gpu = headset_->renderer_name();
        } catch (const Error& e) {
            out_.reasons["vr"] = e.what();
        }
    }
    void headset() {
        for (const int cameras : {1, 2})
            for (const auto& [preset, quality] : {std::pair{"low", render::SceneQuality::low},
                                                  std::pair{"high", render::SceneQuality::high}})
                for (const std::string renderer : {"splat", "mesh", "blend"}) {
                    if (renderer == "splat" && quality == render::SceneQuality::high)
                        continue;  // no row of the paper
                    add("vr/" + std::to_string(cameras) + "/" + renderer + "/" + preset,
                        headset_->picture_ms(cameras, renderer, quality, options_.headset));
                }
    }

    void session(const std::string& way, const std::string& depth_codec) {
        InteractionBench bench;
        for (const std::string& camera : options_.cameras)
            bench.cameras.push_back(played_for_long(camera));
        bench.people = 1;
        bench.seconds = options_.session_seconds;
        bench.warmup_seconds = 2;
        bench.depth_codec = depth_codec;
        const nlohmann::json r = bench_interaction(bench);
        const std::string place = "session/" + way + "/";
        const double per_second = r["pictures"]["fps_min"].get<double>();
        if (per_second > 0)
            add(place + "interval_ms", 1000 / per_second);
        const auto add_median = [&](const char* key, const nlohmann::json& times) {
            if (times["count"].get<std::size_t>() > 0)
                add(place + key, times["p50"].get<double>());
        };
        add_median("move_ms", r["grabs"]["move_ms"]);
        add_median("answer_ms", r["grabs"]["there_and_back_ms"]);
    }

    // Motion to photon needs a film of both screens. Without one, the age of a strip in the drawn
    // picture is measured, between a host and a participant as they are in the program.
    void motion_to_photon() {
        const TemporaryFolder folder;
        const std::string state = folder.path.string();
        ChildProcess host({"host", "--listen", "127.0.0.1:0", "--json", "--state",
                           (folder.path / "host").string(), "--camera", "strip:delay=0"},
                          state);
        const auto greeting = nlohmann::json::parse(host.read_line(), nullptr, false);
        if (!greeting.is_object())
            throw Error("The host of the strip did not start; its message is above.");
        ChildProcess reader(
            {"photon", "read", greeting["link"], "--size", photon_picture, "--seconds",
             std::to_string(options_.session_seconds + begin_s), "--json"},
            state);
        const auto read = nlohmann::json::parse(reader.read_line(), nullptr, false);
        if (reader.wait().exit_code != 0 || !read.is_object())
            throw Error(
                "The strip was not read in the drawn pictures; the lines before the table have the "
                "reason.");
        add("photon/inside", read["age_ms"]["median"]);
        out_.stages.clear();
        for (const auto& stage : read["stages"])
            out_.stages.push_back({stage["until"], stage["what"], stage["mean_ms"]});
        host.interrupt();
        (void)host.wait();
    }

    const Table1Options& options_;
    const capture::Progress& progress_;
    Table1Measured out_;
    std::vector<CameraFrames> cameras_;
    std::vector<DepthImage> cropped_depth_;
    std::vector<ColorImage> color_, cropped_color_;
    std::vector<std::string> depth_codecs_ = {"rvl", "trvl", "strata"};
    std::vector<std::string> color_codecs_ = {"jpeg:quality=85"};
    std::optional<HeadsetBench> headset_;
    int run_ = 0;
};

}  // namespace

void make_quick(Table1Options& options) {
    options.frames = std::min(options.frames, 4);
    options.runs = 1;
    options.eye = {160, 176};
    options.headset = {1, 0};
    options.session_seconds = 2;
}

Table1Measured measure_table1(const Table1Options& options, const capture::Progress& progress) {
    return Measuring(options, progress).run();
}

}  // namespace theatron::bench
