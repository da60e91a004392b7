// SPDX-License-Identifier: Apache-2.0
#include "bench_pipeline.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "child_process.h"

namespace theatron::app {
namespace {

// A folder for the host's identity and report, gone afterwards.
struct TemporaryFolder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("theatron_bench_" + std::to_string(getpid()));
    TemporaryFolder() { std::filesystem::create_directories(path); }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

// The slowest camera's figure for each stage.
nlohmann::json slowest_stages(const nlohmann::json& host) {
    std::vector<nlohmann::json> stages;
    for (const auto& camera : host["cameras"])
        for (const auto& stage : camera["stages"]) {
            const auto same = std::find_if(stages.begin(), stages.end(), [&](const auto& s) {
                return s["name"] == stage["name"];
            });
            if (same == stages.end())
                stages.push_back(stage);
            else if (stage["p99_ms"] > (*same)["p99_ms"])
                *same = stage;
        }
    return stages;
}

}  // namespace

nlohmann::json bench_pipeline(const PipelineBench& bench) {
    const TemporaryFolder folder;
    const std::string summary_file = (folder.path / "host.json").string();
    std::vector<std::string> arguments = {
        "host",      "--listen",   "127.0.0.1:0", "--json",    "--state", folder.path.string(),
        "--summary", summary_file, "--filter",    bench.filter};
    for (const std::string& camera : bench.cameras) {
        arguments.push_back("--camera");
        arguments.push_back(camera);
    }
    ChildProcess host(arguments);
    const auto greeting = nlohmann::json::parse(host.read_line(), nullptr, false);
    if (!greeting.is_object())
        throw Error("The host did not start; its message is above.");

    std::vector<std::unique_ptr<ChildProcess>> viewers;
    for (int i = 0; i < bench.viewers; ++i)
        viewers.push_back(std::make_unique<ChildProcess>(std::vector<std::string>{
            "join", greeting["link"].get<std::string>(), "--json", "--depth-codec",
            bench.depth_codec, "--color-codec", bench.color_codec, "--target-latency", "0",
            "--warmup", std::to_string(bench.warmup_seconds), "--seconds",
            std::to_string(bench.seconds)}));

    double fps_min = 1e9, mbit = 0, p50 = 0, p99 = 0, max = 0, cpu_seconds = 0, memory = 0;
    std::uint64_t dropped = 0;
    for (const auto& viewer : viewers) {
        const auto figures = nlohmann::json::parse(viewer->read_line(), nullptr, false);
        const ChildProcess::End end = viewer->wait();
        if (end.exit_code != 0 || !figures.is_object())
            throw Error("A viewer failed; its message is above.");
        for (const auto& camera : figures["cameras"])
            fps_min = std::min(fps_min, camera["frames"].get<double>() / bench.seconds);
        mbit += figures["mbit_per_s"].get<double>();
        p50 = std::max(p50, figures["age_ms"]["p50"].get<double>());
        p99 = std::max(p99, figures["age_ms"]["p99"].get<double>());
        max = std::max(max, figures["age_ms"]["max"].get<double>());
        dropped += figures["dropped"].get<std::uint64_t>();
        cpu_seconds += end.cpu_seconds;
        memory = std::max(memory, end.peak_memory_mb);
    }
    host.interrupt();
    const ChildProcess::End host_end = host.wait();
    cpu_seconds += host_end.cpu_seconds;
    const auto report = nlohmann::json::parse(std::ifstream(summary_file), nullptr, false);
    if (!report.is_object())
        throw Error("The host left no report.");
    for (const auto& camera : report["cameras"])
        dropped += camera["dropped_newest"].get<std::uint64_t>();

    const double cameras = double(bench.cameras.size());
    return {{"cameras", bench.cameras.size()},
            {"viewers", bench.viewers},
            {"seconds", bench.seconds},
            {"depth_codec", bench.depth_codec},
            {"color_codec", bench.color_codec},
            {"stages", slowest_stages(report)},
            {"fps_min", fps_min},
            {"frames_dropped", dropped},
            {"mbit_per_camera", mbit / cameras / bench.viewers},
            {"cpu_cores", cpu_seconds / (bench.seconds + bench.warmup_seconds)},
            {"host_memory_mb", host_end.peak_memory_mb},
            {"viewer_memory_mb", memory},
            {"age_ms", {{"p50", p50}, {"p99", p99}, {"max", max}}}};
}

}  // namespace theatron::app
