// SPDX-License-Identifier: Apache-2.0
#include "bench_capacity.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "bench_pipeline.h"
#include "bench_report.h"
#include "capacity_model.h"
#include "cli/camera_option.h"
#include "cli/number_check.h"
#include "cli/progress.h"
#include "this_machine.h"

namespace theatron::bench {
namespace {

constexpr double gigabit = 940;  // Mbit/s of a gigabit line that TCP carries

struct CapacityFlags {
    std::vector<std::string> cameras;
    int most_cameras = 2, most_viewers = 4;
    double seconds = 10;
    std::string json;
};

nlohmann::json parts_json(const CapacityModel::Parts& parts) {
    return {{"base", parts.base}, {"a_camera", parts.a_camera}, {"a_stream", parts.a_stream}};
}

nlohmann::json measure(const CapacityFlags& flags) {
    const capture::Progress progress = cli::show_progress();
    require_outputs({flags.json});
    std::vector<CapacityRun> runs;
    nlohmann::json lines = nlohmann::json::array();
    double others = 0;
    const std::pair<int, int> numbers[] = {{1, 1},
                                           {flags.most_cameras, 1},
                                           {1, flags.most_viewers},
                                           {flags.most_cameras, flags.most_viewers}};
    for (const auto& [cameras, viewers] : numbers) {
        progress("measuring cameras and viewers", double(runs.size()) / double(std::size(numbers)));
        PipelineBench bench;
        for (int i = 0; i < cameras; ++i)
            bench.cameras.push_back(flags.cameras[std::size_t(i) % flags.cameras.size()]);
        bench.viewers = viewers;
        bench.seconds = flags.seconds;
        // As a participant has it who chooses none: it needs a while to find its way.
        bench.color_codec = "auto";
        bench.warmup_seconds = 12;
        const nlohmann::json r = bench_pipeline(bench);
        const double frames = r["frames_per_viewer"], dropped = r["frames_dropped"];
        runs.push_back({cameras, viewers, r["host_cores"], r["viewer_cores"], r["mbit_per_camera"],
                        r["host_memory_mb"], frames / std::max(frames + dropped / viewers, 1.0)});
        others = std::max(others, r["cpu_cores_of_others"].get<double>());
        lines.push_back({{"cameras", cameras},
                         {"viewers", viewers},
                         {"host_cores", r["host_cores"]},
                         {"viewer_cores", r["viewer_cores"]},
                         {"mbit_per_camera", r["mbit_per_camera"]},
                         {"host_memory_mb", r["host_memory_mb"]},
                         {"fps_min", r["fps_min"]},
                         {"age_p99_ms", r["age_ms"]["p99"]},
                         {"carried", runs.back().carried}});
    }
    progress("measuring cameras and viewers", 1);
    const auto model = capacity_model(runs);
    if (!model)
        throw Error(
            "Pictures were missing in too many runs: this machine is too busy, or too small for "
            "host and viewers together. Try --cameras 2 --viewers 2, alone.");
    const double cores = std::thread::hardware_concurrency();
    nlohmann::json table = nlohmann::json::array();
    for (const int cameras : {1, 2, 4, 8})
        table.push_back({{"cameras", cameras},
                         {"host_cores", model->host_cores.at(cameras, 0)},
                         {"viewers_of_this_machine", viewers_of(*model, cameras, cores, gigabit)},
                         {"viewers_of_8_cores", viewers_of(*model, cameras, 8, gigabit)},
                         {"mbit_a_viewer", model->mbit_a_stream * cameras},
                         {"viewer_cores", model->viewer_cores_a_camera * cameras}});
    return {{"processor", processor_name()},
            {"cores", cores},
            {"cores_of_others", others},
            {"runs", lines},
            {"host_cores", parts_json(model->host_cores)},
            {"host_memory_mb", parts_json(model->host_memory_mb)},
            {"viewer_cores_a_camera", model->viewer_cores_a_camera},
            {"mbit_a_stream", model->mbit_a_stream},
            {"largest_error", model->largest_error},
            {"computed", table}};
}

void print_capacity(const nlohmann::json& r) {
    std::printf("%s, %.0f cores\n\nmeasured\n", r["processor"].get<std::string>().c_str(),
                r["cores"].get<double>());
    std::printf("  %7s %7s %11s %13s %14s %11s %9s\n", "cameras", "viewers", "host cores",
                "viewer cores", "Mbit/s camera", "lowest fps", "pictures");
    for (const auto& run : r["runs"])
        std::printf("  %7d %7d %11.2f %13.2f %14.1f %11.1f %8.1f%%\n", run["cameras"].get<int>(),
                    run["viewers"].get<int>(), run["host_cores"].get<double>(),
                    run["viewer_cores"].get<double>(), run["mbit_per_camera"].get<double>(),
                    run["fps_min"].get<double>(), 100 * run["carried"].get<double>());
    const auto& host = r["host_cores"];
    std::printf(
        "\na host needs %.2f cores, and %.2f for each camera, and %.3f for each camera of each "
        "viewer (off by %.0f %% at most)\n",
        host["base"].get<double>(), host["a_camera"].get<double>(), host["a_stream"].get<double>(),
        100 * r["largest_error"].get<double>());
    std::printf("\ncomputed from this, with a gigabit line and a tenth of the cores free\n");
    std::printf("  %7s %11s %21s %16s %14s %18s\n", "cameras", "host cores",
                "viewers, this machine", "viewers, 8 cores", "Mbit/s viewer", "cores of a viewer");
    for (const auto& line : r["computed"])
        std::printf("  %7d %11.2f %21d %16d %14.0f %18.2f\n", line["cameras"].get<int>(),
                    line["host_cores"].get<double>(), line["viewers_of_this_machine"].get<int>(),
                    line["viewers_of_8_cores"].get<int>(), line["mbit_a_viewer"].get<double>(),
                    line["viewer_cores"].get<double>());
    if (const double others = r["cores_of_others"].get<double>(); others > 0.2)
        std::printf("\nother programs used %.2f cores meanwhile: measure again alone\n", others);
}

}  // namespace

void add_capacity_bench(CLI::App& bench) {
    const auto flags = std::make_shared<CapacityFlags>();
    CLI::App* command = bench.add_subcommand(
        "capacity", "Cameras and viewers that this machine can carry as a host");
    command->footer(
        "A host and viewers run four times on this machine, for two minutes in all; the rest is "
        "computed from that.\n"
        "Example: theatron bench capacity\n"
        "Example: theatron bench capacity --camera recording:operation.mkv --json capacity.json");
    cli::add_camera_option(*command, flags->cameras,
                           "A camera or recording, kind:value,key=value; the generated room "
                           "without it");
    command->add_option("--cameras", flags->most_cameras, "Cameras of the larger runs")
        ->capture_default_str()
        ->check(CLI::Range(2, 16));
    command->add_option("--viewers", flags->most_viewers, "Viewers of the larger runs")
        ->capture_default_str()
        ->check(CLI::Range(2, 64));
    command->add_option("--seconds", flags->seconds, "Measured time of a run")
        ->capture_default_str()
        ->check(cli::number_from_to(2, 3600));
    add_json_option(*command, flags->json);
    command->callback([flags] {
        if (flags->cameras.empty())
            flags->cameras = {"synthetic:room,seconds=2,camera=0",
                              "synthetic:room,seconds=2,camera=1"};
        const nlohmann::json result = measure(*flags);
        report(result, flags->json, [&] { print_capacity(result); });
    });
}

}  // namespace theatron::bench
