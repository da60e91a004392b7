// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "bench_capacity.h"
#include "bench_color.h"
#include "bench_commands.h"
#include "bench_compare.h"
#include "bench_depth.h"
#include "bench_face.h"
#include "bench_filter.h"
#include "bench_interaction.h"
#include "bench_pipeline.h"
#include "bench_plot.h"
#include "bench_registration.h"
#include "bench_relay.h"
#include "bench_render.h"
#include "bench_report.h"
#include "bench_sequence.h"
#include "bench_slices.h"
#include "bench_table1.h"
#include "bench_view.h"
#include "bench_voice.h"
#include "bench_web.h"
#include "capture/crop.h"
#include "capture/tiled_recording.h"
#include "cli/camera_option.h"
#include "cli/number_check.h"
#include "cli/progress.h"
#include "codec/depth_codec.h"
#include "codec/rows.h"
#include "render/cloud_set.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::bench {
namespace {

// The similarity of a lossy codec's result to its input, for the table.
std::string likeness(const nlohmann::json& codec) {
    if (codec["lossless"].get<bool>())
        return "";
    char text[80] = "  lossy";
    if (codec.contains("rmse_mm"))
        std::snprintf(text, sizeof(text), "  lossy: RMSE %.1f, at most %d mm",
                      codec["rmse_mm"].get<double>(), codec["max_error_mm"].get<int>());
    else if (codec.contains("psnr_db") && codec["psnr_db"].is_number())
        std::snprintf(text, sizeof(text), "  lossy: PSNR %.1f dB, SSIM %.4f",
                      codec["psnr_db"].get<double>(), codec["ssim"].get<double>());
    return text;
}

void print_codecs(const nlohmann::json& sequences) {
    for (const auto& sequence : sequences) {
        std::printf("%s  %dx%d, %d frames\n", sequence["sequence"].get<std::string>().c_str(),
                    sequence["width"].get<int>(), sequence["height"].get<int>(),
                    sequence["frames"].get<int>());
        std::printf("  %-28s %9s %9s %7s %10s %10s\n", "codec", "first kB", "mean kB", "ratio",
                    "encode ms", "decode ms");
        for (const auto& c : sequence["codecs"])
            std::printf("  %-28s %9.1f %9.1f %7.2f %10.2f %10.2f%s\n",
                        c["name"].get<std::string>().c_str(), c["bytes_first"].get<double>() / 1000,
                        c["bytes_mean"].get<double>() / 1000, c["ratio"].get<double>(),
                        c["encode_ms"].get<double>(), c["decode_ms"].get<double>(),
                        likeness(c).c_str());
    }
}

struct CodecFlags {
    std::vector<std::string> folders;
    std::vector<std::string> codecs;
    int frames = 150;
    std::string json;
    std::string plot;
    std::string crop;
    std::string tile;
    double camera_noise = 0;
};

CLI::App* add_codec_bench(CLI::App& bench, const char* name, const char* help, CodecFlags& flags) {
    CLI::App* command = bench.add_subcommand(name, help);
    command->add_option("folder", flags.folders, "Folders with depth/*.png and color/*")
        ->required();
    command->add_option("--codecs", flags.codecs,
                        "Names of codecs, separated by blanks (default: all)");
    command->add_option("--frames", flags.frames, "Most frames of each")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    add_json_option(*command, flags.json);
    command->add_option("--plot", flags.plot, "Draw size against speed into this SVG file");
    return command;
}

void write_plot(const nlohmann::json& sequences, const std::string& file) {
    if (file.empty())
        return;
    std::ofstream out(file);
    out << size_speed_svg(sequences);
    if (!out.flush())
        throw Error("Cannot write " + file + ".");
}

void crop_depth(BenchSequence& sequence, const std::string& text) {
    if (text.empty())
        return;
    const auto crop = capture::parse_crop(text);
    if (!crop)
        throw Error("--crop " + text + " is not X:Y:WxH, for example --crop 50:50:540x476.");
    for (DepthImage& depth : sequence.depth) {
        if (!capture::lies_in(*crop, depth.size))
            throw Error("--crop " + text + " reaches beyond the pictures of " + sequence.name +
                        ".");
        DepthImage part(crop->size);
        codec::copy_rows(capture::part_of(std::as_const(depth).view(), *crop), part.view());
        depth = std::move(part);
    }
}

// The depth codecs that this machine can encode.
std::vector<std::string> depth_codecs_here() {
    std::vector<std::string> names;
    for (const std::string& name : video::depth_codec_names())
        if (video::missing_depth_encoder(video::parse_depth_setting(name).setting).empty())
            names.push_back(name);
    return names;
}

void add_depth(CLI::App& bench) {
    const auto flags = std::make_shared<CodecFlags>();
    CLI::App* command = add_codec_bench(
        bench, "depth", "Depth codecs: size and speed, checked, one thread", *flags);
    command->add_option("--crop", flags->crop, "Only this part of the depth, X:Y:WxH");
    command->footer(
        "Example: theatron bench depth recordings/table --codecs rvl trvl --json depth.json");
    command->callback([flags] {
        const auto codecs = flags->codecs.empty() ? depth_codecs_here() : flags->codecs;
        nlohmann::json sequences = nlohmann::json::array();
        for (const std::string& folder : flags->folders) {
            BenchSequence s = load_sequence(folder, false, flags->frames);
            crop_depth(s, flags->crop);
            sequences.push_back(bench_depth_sequence(s.name, s.depth, codecs));
        }
        const nlohmann::json result = sequences.size() == 1 ? sequences[0] : sequences;
        report(result, flags->json, [&] { print_codecs(sequences); });
        write_plot(sequences, flags->plot);
    });
}

void tile_color(BenchSequence& sequence, const std::string& text) {
    if (text.empty())
        return;
    Size size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 ||
        !is_valid(size))
        throw Error("--tile " + text + " is not WIDTHxHEIGHT, for example --tile 640x576.");
    for (ColorImage& picture : sequence.color)
        picture = capture::tiled(picture, size);
}

// The colour codecs that this machine can encode.
std::vector<std::string> color_codecs_here() {
    std::vector<std::string> names;
    for (const std::string& name : video::color_codec_names())
        if (video::missing_color_encoder(video::parse_color_setting(name).setting).empty())
            names.push_back(name);
    return names;
}

void add_color(CLI::App& bench) {
    const auto flags = std::make_shared<CodecFlags>();
    CLI::App* command = add_codec_bench(
        bench, "color", "Colour codecs: size, speed and likeness, one thread", *flags);
    command->add_option("--tile", flags->tile, "Pictures repeated in space to this WIDTHxHEIGHT");
    command->add_option("--camera-noise", flags->camera_noise,
                        "Codecs get what a camera with this noise makes of the pictures, as "
                        "JPEG; 1.6 is usual");
    command->footer("Example: theatron bench color recordings/table --codecs jpeg:quality=85");
    command->callback([flags] {
        const auto codecs = flags->codecs.empty() ? color_codecs_here() : flags->codecs;
        nlohmann::json sequences = nlohmann::json::array();
        for (const std::string& folder : flags->folders) {
            BenchSequence s = load_sequence(folder, true, flags->frames);
            tile_color(s, flags->tile);
            sequences.push_back(bench_color_sequence(s.name, s.color, codecs, flags->camera_noise));
        }
        const nlohmann::json result = sequences.size() == 1 ? sequences[0] : sequences;
        report(result, flags->json, [&] { print_codecs(sequences); });
        write_plot(sequences, flags->plot);
    });
}

void add_pipeline(CLI::App& bench) {
    struct Flags {
        PipelineBench bench;
        int cameras = 0;
        std::string json;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = bench.add_subcommand(
        "pipeline", "From cameras to decoded images, host and viewers in processes of their own");
    command->footer(
        "Example: theatron bench pipeline --camera folder:recordings/table,loop=1,preload=1 "
        "--cameras 4 --seconds 20");
    cli::add_camera_option(*command, flags->bench.cameras)->required();
    command->add_option("--cameras", flags->cameras,
                        "Number of cameras in all, by using those given again");
    command->add_option("--viewers", flags->bench.viewers, "Participants")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    command->add_option("--seconds", flags->bench.seconds, "Measured time")
        ->capture_default_str()
        ->check(CLI::Range(1, 86400));
    command->add_option("--warmup", flags->bench.warmup_seconds, "Time before that")
        ->capture_default_str();
    command->add_option("--depth-codec", flags->bench.depth_codec, "Of all viewers")
        ->capture_default_str();
    command->add_option("--color-codec", flags->bench.color_codec, "Of all viewers")
        ->capture_default_str();
    command->add_option("--filter", flags->bench.filter, "Of all cameras")->capture_default_str();
    add_json_option(*command, flags->json);
    command->callback([flags] {
        PipelineBench b = flags->bench;
        for (std::size_t i = 0; b.cameras.size() < std::size_t(flags->cameras); ++i)
            b.cameras.push_back(flags->bench.cameras[i % flags->bench.cameras.size()]);
        const nlohmann::json r = bench_pipeline(b);
        report(r, flags->json, [&] {
            std::printf("%d camera(s), %d viewer(s), %.0f s, %s + %s\n", r["cameras"].get<int>(),
                        r["viewers"].get<int>(), r["seconds"].get<double>(), b.depth_codec.c_str(),
                        b.color_codec.c_str());
            std::printf(
                "  lowest %.2f fps, %lu frame(s) dropped, %.1f Mbit/s a camera, %.2f cores\n",
                r["fps_min"].get<double>(), r["frames_dropped"].get<unsigned long>(),
                r["mbit_per_camera"].get<double>(), r["cpu_cores"].get<double>());
            std::printf("  age when decoded: p50 %.1f ms, p99 %.1f ms, max %.1f ms\n",
                        r["age_ms"]["p50"].get<double>(), r["age_ms"]["p99"].get<double>(),
                        r["age_ms"]["max"].get<double>());
            std::printf("  memory: host %.0f MB (%+.1f in the run), viewer %.0f MB (%+.1f)\n",
                        r["host_memory_mb"].get<double>(), r["memory_growth_mb"].get<double>(),
                        r["viewer_memory_mb"].get<double>(),
                        r["viewer_memory_growth_mb"].get<double>());
            std::printf(
                "  this machine could carry %.1f cameras; %s would be full first, the host's "
                "costliest stage is %s\n",
                r["cameras_possible"].get<double>(), r["ends_first"].get<std::string>().c_str(),
                r["costliest_stage"].get<std::string>().c_str());
            std::printf(
                "  %s: %.2f ms of a core for a frame of a camera, %.2f of zstd1 (%.2f ms)\n",
                r["target"].get<std::string>().c_str(), r["frame_cpu_ms"].get<double>(),
                r["frame_cpu_of_zstd1"].get<double>(), r["yardstick_ms"].get<double>());
            if (const double others = r["cpu_cores_of_others"].get<double>(); others > 0.2)
                std::printf("  other programs used %.2f cores meanwhile: measure again alone\n",
                            others);
            for (const auto& stage : r["stages"])
                std::printf("  %-14s p50 %6.2f ms  p99 %6.2f ms\n",
                            stage["name"].get<std::string>().c_str(), stage["p50_ms"].get<double>(),
                            stage["p99_ms"].get<double>());
        });
    });
}

void add_interaction(CLI::App& bench) {
    struct Flags {
        InteractionBench bench;
        int generated = 0;
        std::string json;
    };
    const auto flags = std::make_shared<Flags>();
    InteractionBench& b = flags->bench;
    CLI::App* command = bench.add_subcommand(
        "interaction",
        "How late actions of others in the room are while pictures come, between processes");
    command->footer(
        "Example: theatron bench interaction --cameras 4 --json -\n"
        "tests/end_to_end/interaction_run.py puts a slow link between host and viewer.");
    cli::add_camera_option(*command, b.cameras);
    command->add_option("--cameras", flags->generated, "Number of generated cameras, made before")
        ->check(CLI::Range(1, 16));
    command->add_option("--people", b.people, "Participants that move; two more move and act")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    command->add_option("--seconds", b.seconds, "Measured time")
        ->capture_default_str()
        ->check(cli::number_from_to(2.0, 86400.0));
    command->add_option("--warmup", b.warmup_seconds, "Time before that")->capture_default_str();
    command->add_option("--target-latency", b.target_latency_ms, "Of the viewer's pictures, ms")
        ->capture_default_str()
        ->check(CLI::Range(0, 10000));
    command->add_option("--depth-codec", b.depth_codec, "Of all")->capture_default_str();
    command->add_option("--color-codec", b.color_codec, "Of all")->capture_default_str();
    command->add_option("--host-namespace", b.host_namespace, "Network namespace of the host");
    command->add_option("--viewer-namespace", b.viewer_namespace, "Network namespace of the viewer")
        ->needs("--host-namespace");
    command->add_option("--link-delay", b.link_delay_ms, "Of the link between them, one way, ms")
        ->capture_default_str()
        ->check(cli::number_from_to(0.0, 10000.0));
    command->add_option("--cases", b.cases, "A folder; the viewer fetches its first case");
    command
        ->add_option("--crowd", b.crowd,
                     "Busy threads on the one core that the viewer's decoders may use")
        ->capture_default_str()
        ->check(CLI::Range(0, 16));
    command->add_flag("--draw", b.draws,
                      "One more participant draws all cameras in a window, which needs a display");
    add_json_option(*command, flags->json);
    command->callback([flags] {
        for (int i = 0; i < flags->generated; ++i)
            flags->bench.cameras.push_back("synthetic:color=depth,preload=1");
        if (flags->bench.cameras.empty())
            throw Error("Say which cameras stream meanwhile: --cameras 4, or --camera SPEC.");
        const nlohmann::json r = bench_interaction(flags->bench);
        report(r, flags->json, [&] {
            std::printf("%d participants, %d camera(s), %zu poses\n", r["participants"].get<int>(),
                        r["cameras"].get<int>(), r["poses"].get<std::size_t>());
            std::printf("  poses, beyond the link's delay: p50 %.1f ms, p99 %.1f ms, max %.1f ms\n",
                        r["p50_ms"].get<double>(), r["p99_ms"].get<double>(),
                        r["max_ms"].get<double>());
            std::printf("  the same at one who takes no pictures: p50 %.1f ms, p99 %.1f ms\n",
                        r["poses_without_pictures_ms"]["p50"].get<double>(),
                        r["poses_without_pictures_ms"]["p99"].get<double>());
            std::printf("  round trips, the same: p50 %.1f ms, p99 %.1f ms\n",
                        r["round_trip_ms"]["p50"].get<double>(),
                        r["round_trip_ms"]["p99"].get<double>());
            const auto print_times = [&](const char* what, const nlohmann::json& times) {
                if (times["count"] == 0)
                    std::printf("  %s: none came\n", what);
                else
                    std::printf("  %s: p50 %.1f ms, p95 %.1f ms, p99 %.1f ms, of %zu\n", what,
                                times["p50"].get<double>(), times["p95"].get<double>(),
                                times["p99"].get<double>(), times["count"].get<std::size_t>());
            };
            print_times("a movement, at another participant", r["grabs"]["move_ms"]);
            print_times("there and back", r["grabs"]["there_and_back_ms"]);
            print_times("a grab or release, at another participant", r["grabs"]["grab_ms"]);
            std::printf("  host: %.2f cores\n", r["host_cores"].get<double>());
            if (r["drawn"].is_number())
                std::printf("  the window: %d pictures of 1280x720\n", r["drawn"].get<int>());
            const auto& pictures = r["pictures"];
            std::printf("  pictures: lowest %.1f fps, %.1f Mbit/s, age p50 %.0f ms, p99 %.0f ms\n",
                        pictures["fps_min"].get<double>(), pictures["mbit_per_s"].get<double>(),
                        pictures["age_ms"]["p50"].get<double>(),
                        pictures["age_ms"]["p99"].get<double>());
        });
    });
}

void add_render(CLI::App& bench) {
    struct Flags {
        int cameras = 4, depth_step = 1;
        std::string json;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command =
        bench.add_subcommand("render", "Renderers: time of a picture and of an upload, checked");
    command->footer("Example: theatron bench render --cameras 4 --json render.json");
    command->add_option("--cameras", flags->cameras, "Generated cameras")
        ->capture_default_str()
        ->check(CLI::Range(1, 16));
    command
        ->add_option("--depth-step", flags->depth_step,
                     "Draw the depth pixels of one column and row in this number only, as a window "
                     "does that is too slow otherwise")
        ->capture_default_str()
        ->check(CLI::Range(1, 8));
    add_json_option(*command, flags->json);
    command->callback([flags] {
        RenderBench b;
        b.cameras = generated_render_cameras(flags->cameras);
        b.depth_step = flags->depth_step;
        const nlohmann::json r = bench_render(b);
        report(r, flags->json, [&] {
            std::printf("%s, %dx%d, %d camera(s)\n", r["gl_renderer"].get<std::string>().c_str(),
                        r["width"].get<int>(), r["height"].get<int>(), r["cameras"].get<int>());
            for (const auto& renderer : r["renderers"])
                std::printf("  %-12s picture %7.2f ms  upload of a camera %6.2f ms\n",
                            renderer["name"].get<std::string>().c_str(),
                            renderer["frame_ms"].get<double>(),
                            renderer["upload_ms"].get<double>());
            for (const auto& room : r["rooms"])
                std::printf("  %-12s picture %7.2f ms  built in %6.2f ms\n",
                            room["name"].get<std::string>().c_str(), room["frame_ms"].get<double>(),
                            room["build_ms"].get<double>());
        });
    });
}

void add_view(CLI::App& bench) {
    struct Flags {
        ViewBenchOptions scene;
        std::vector<std::string> renderers;
        std::string filter = "default", pictures, json;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = bench.add_subcommand(
        "view", "Renderers: pictures of the generated operating room beside the exact ones");
    command->footer("Example: theatron bench view --cameras 4 --json view.json");
    command->add_option("--cameras", flags->scene.cameras, "Generated cameras")
        ->capture_default_str()
        ->check(CLI::Range(1, 12));
    command->add_option("--renderers", flags->renderers,
                        "Names of renderers, separated by blanks (default: all)");
    command
        ->add_option("--exposure", flags->scene.exposure_stops,
                     "How far the cameras' exposures differ, in stops")
        ->capture_default_str()
        ->check(cli::number_from_to(0.0, 1.0));
    command
        ->add_option("--filter", flags->filter,
                     "Of all cameras: off, paper, default, stereo or a line")
        ->capture_default_str();
    command->add_option("--detail", flags->scene.detail, "Of the generated room, 0.3 to 1")
        ->capture_default_str()
        ->check(cli::number_from_to(0.3, 1.0));
    command->add_option("--pictures", flags->pictures, "Write the pictures to this folder");
    add_json_option(*command, flags->json);
    command->callback([flags] {
        for (const std::string& renderer : flags->renderers)
            render::check_renderer_name(renderer);
        const filter::ParsedChain filter = filter::parse_chain(flags->filter);
        if (!filter.problem.empty())
            throw Error(filter.problem);
        if (filter.settings.needs_background())
            throw Error("The generated room has no recorded background; leave out 'background'.");
        flags->scene.filter = filter.settings;
        const capture::Progress progress = cli::show_progress();
        const ViewBenchScene scene = make_view_bench_scene(flags->scene, progress);
        nlohmann::json r = bench_view(scene, flags->renderers, flags->pictures, progress);
        r["exposure_stops"] = flags->scene.exposure_stops;
        r["filter"] = flags->filter;
        report(r, flags->json, [&] {
            std::printf("%s, %dx%d, %d camera(s), %d views, filters: %s\n",
                        r["gl_renderer"].get<std::string>().c_str(), r["width"].get<int>(),
                        r["height"].get<int>(), r["cameras"].get<int>(), r["views"].get<int>(),
                        flags->filter.c_str());
            std::printf("  %-8s %8s %10s %6s %8s %11s %9s %13s %6s %12s %11s\n", "renderer",
                        "PSNR dB", "in overlap", "SSIM", "holes %", "outline px", "flicker",
                        "patterned dB", "1080p", "depth-sized", "registered");
            for (const auto& v : r["renderers"])
                std::printf(
                    "  %-8s %8.2f %10.2f %6.3f %8.2f %11.2f %9.2f %13.2f %6.2f %12.2f %11.2f\n",
                    v["name"].get<std::string>().c_str(), v["psnr_db"].get<double>(),
                    v["psnr_overlap_db"].get<double>(), v["ssim"].get<double>(),
                    v["holes_percent"].get<double>(), v["silhouette_px"].get<double>(),
                    v["flicker_overlap"].get<double>(), v["psnr_patterned_db"].get<double>(),
                    v["psnr_patterned_fine_db"].get<double>(),
                    v["psnr_patterned_depth_sized_db"].get<double>(),
                    v["psnr_patterned_registered_db"].get<double>());
        });
    });
}

struct RegistrationFlags {
    RegistrationBenchOptions options;
    bool quick = false;
    std::string json;
};

void add_registration(CLI::App& bench) {
    const auto flags = std::make_shared<RegistrationFlags>();
    CLI::App* command = bench.add_subcommand(
        "registration", "The board found and cameras registered, against exact truth");
    flags->options.threads = std::max(1, int(std::thread::hardware_concurrency()));
    const auto add = [&](const char* name, int& value, const char* help, int least, int most) {
        return command->add_option(name, value, help)
            ->capture_default_str()
            ->check(CLI::Range(least, most));
    };
    std::vector<CLI::Option*> amounts{
        add("--images", flags->options.images, "Single images for detection", 4, 100000),
        add("--seeds", flags->options.seeds, "Number of sets of cameras and poses", 1, 1000),
        add("--frames", flags->options.frames, "Frames averaged for a view", 1, 90)};
    add("--threads", flags->options.threads, "Seeds at once; changes no result", 1, 256);
    CLI::Option* quick = command->add_flag(
        "--quick", flags->quick,
        "40 images, 2 seeds and 5 frames: whether all works, in a minute; says little of errors");
    for (CLI::Option* amount : amounts)
        quick->excludes(amount);
    add_json_option(*command, flags->json);
    command->callback([flags] {
        if (flags->quick) {
            const int threads = flags->options.threads;
            flags->options = quick_registration_bench;
            flags->options.threads = threads;
        }
        const nlohmann::json r = bench_registration(flags->options, cli::show_progress());
        report(r, flags->json, [&] {
            const auto& d = r["detection"];
            std::printf(
                "board found in %d images: precision %.3f, recall %.3f, %.1f ms (90 %%: "
                "%.1f ms, zstd -1 of the image: %.1f ms)\n",
                d["images"].get<int>(), d["precision"].get<double>(), d["recall"].get<double>(),
                d["ms"].get<double>(), d["p90_ms"].get<double>(), d["zstd1_ms"].get<double>());
            std::printf("%8s %6s %7s %5s %5s %7s %9s %5s %6s %7s %9s %7s %8s\n", "distance",
                        "angle", "cameras", "poses", "fixed", "bias mm", "occlusion", "noise",
                        "solved", "mean mm", "median mm", "p90 mm", "solve ms");
            for (const auto& c : r["registration"])
                std::printf(
                    "%8.1f %6.0f %7d %5d %5s %7.1f %9.1f %5.1f %3d/%-2d %7.2f %9.2f %7.2f %8.0f\n",
                    c["distance_m"].get<double>(), c["angle_deg"].get<double>(),
                    c["cameras"].get<int>(), c["poses"].get<int>(),
                    c["fixed_errors"].get<bool>() ? "yes" : "no", c["bias_mm"].get<double>(),
                    c["occlusion"].get<double>(), c["noise"].get<double>(), c["solved"].get<int>(),
                    c["seeds"].get<int>(), c["mean_error_mm"].get<double>(),
                    c["median_error_mm"].get<double>(), c["p90_error_mm"].get<double>(),
                    c["solve_ms"].get<double>());
        });
    });
}

}  // namespace

void add_benchmarks(CLI::App& app) {
    add_depth(app);
    add_color(app);
    add_filter_bench(app);
    add_face_bench(app);
    add_interaction(app);
    add_pipeline(app);
    add_capacity_bench(app);
    add_render(app);
    add_slices_bench(app);
    add_table1_bench(app);
    add_voice_bench(app);
    add_relay_bench(app);
    add_web_bench(app);
    add_view(app);
    add_compare_bench(app);
    add_registration(app);
}

}  // namespace theatron::bench
