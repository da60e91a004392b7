// SPDX-License-Identifier: Apache-2.0
#include "bench_pipeline.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "base/error.h"
#include "base/statistics.h"
#include "base/steady_clock.h"
#include "bench_coder.h"
#include "child_process.h"
#include "cli/instruction_set.h"
#include "host/host_http.h"
#include "process_usage.h"
#include "temporary_folder.h"

namespace theatron::bench {
namespace {

// For each stage, the figures of the slowest camera.
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

// The host's stage with the largest total time.
std::string costliest_stage(const nlohmann::json& host) {
    std::map<std::string, double> total;
    for (const auto& camera : host["cameras"])
        for (const auto& stage : camera["stages"])
            if (const std::string name = stage["name"];
                name != "lane" && name != "capture" && name != "queue")
                total[name] += stage["mean_ms"].get<double>();
    const auto most =
        std::max_element(total.begin(), total.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == total.end() ? "" : most->first;
}

double thread_cpu_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

// Processor time of zstd level 1 on the depth of one generated frame: a measure of the machine's
// current speed.
double yardstick_ms() {
    constexpr Size size{640, 576};
    DepthImage depth(size);
    std::mt19937 rng(1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            depth.view().row(y)[x] = std::uint16_t(1500 + x / 3 + 2 * y + int(rng() % 5));
    const std::unique_ptr<BenchCoder> zstd = zstd_yardstick();
    std::vector<double> times;
    Bytes out;
    for (int i = 0; i < 25; ++i) {
        const double begin = thread_cpu_ms();
        (void)zstd->encode(depth, out);
        times.push_back(thread_cpu_ms() - begin);
    }
    return median(times);
}

// Frames dropped by the host since it started, for lack of time.
std::uint64_t dropped_by_host(const net::Link& link) {
    const nlohmann::json status = host::status_of_host(link);
    std::uint64_t dropped = 0;
    for (const auto& camera : status["cameras"])
        dropped += camera["dropped_newest"].get<std::uint64_t>();
    return dropped;
}

// The resources used by host and viewers so far.
struct UsageSample {
    TimePoint time = steady_now();
    double machine = machine_cpu_seconds();
    ProcessUsage host;
    std::vector<ProcessUsage> viewers;

    UsageSample(const ChildProcess& host_process,
                const std::vector<std::unique_ptr<ChildProcess>>& others)
        : host(usage_of(host_process.pid())) {
        for (const auto& viewer : others)
            viewers.push_back(usage_of(viewer->pid()));
    }
};

// The number of cameras that would saturate the first limited resource: all cores, or a
// thread that cannot be split. `cameras` is the number of cameras carried between the two
// samples: two cameras that each lost half of their frames count as one.
nlohmann::json capacity(const UsageSample& before, const UsageSample& after, double cameras) {
    const double seconds = to_seconds(after.time - before.time);
    const double host = after.host.cpu_seconds - before.host.cpu_seconds;
    double cores = host;
    std::vector<std::pair<std::string, double>> used;
    used.emplace_back("the host's network thread",
                      busiest(before.host, after.host, "net", seconds));
    for (std::size_t i = 0; i < after.viewers.size(); ++i) {
        cores += after.viewers[i].cpu_seconds - before.viewers[i].cpu_seconds;
        for (const char* name : {"net", "decode"})
            used.emplace_back(std::string("a viewer's ") + name + " thread",
                              busiest(before.viewers[i], after.viewers[i], name, seconds));
    }
    const double viewers = (cores - host) / seconds;
    cores /= seconds;
    const double here = std::max(1u, std::thread::hardware_concurrency());
    used.insert(used.begin(), {"all cores", cores / here});
    const auto fullest = std::max_element(
        used.begin(), used.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    nlohmann::json shares;
    for (const auto& [name, share] : used)
        shares[name] = share;
    const double others = (after.machine - before.machine) / seconds - cores;
    return {{"cores", cores},
            {"host", host / seconds},
            {"viewer", viewers / double(after.viewers.size())},
            {"others", std::max(0.0, others)},
            {"cores_here", here},
            {"shares", shares},
            {"ends_first", fullest->first},
            {"cameras_possible", fullest->second > 0 ? cameras / fullest->second : 0}};
}

}  // namespace

nlohmann::json bench_pipeline(const PipelineBench& bench) {
    const double yardstick_before = yardstick_ms();
    const TemporaryFolder folder;
    const std::string summary_file = (folder.path / "host.json").string();
    std::vector<std::string> arguments = {"host",        "--listen",
                                          "127.0.0.1:0", "--json",
                                          "--state",     (folder.path / "state").string(),
                                          "--summary",   summary_file,
                                          "--filter",    bench.filter};
    for (const std::string& camera : bench.cameras) {
        arguments.push_back("--camera");
        arguments.push_back(camera);
    }
    ChildProcess host(arguments);
    const auto greeting = nlohmann::json::parse(host.read_line(), nullptr, false);
    if (!greeting.is_object())
        throw Error("The host did not start; its message is above.");

    const std::string link_text = greeting["link"];
    const net::Link link = net::parse_link(link_text);

    std::vector<std::unique_ptr<ChildProcess>> viewers;
    for (int i = 0; i < bench.viewers; ++i)
        viewers.push_back(std::make_unique<ChildProcess>(
            std::vector<std::string>{
                "join", link_text, "--json", "--depth-codec", bench.depth_codec, "--color-codec",
                bench.color_codec, "--target-latency", "0", "--warmup",
                std::to_string(bench.warmup_seconds), "--seconds", std::to_string(bench.seconds)},
            // A person of its own: one person has few views of a session.
            (folder.path / ("viewer" + std::to_string(i))).string()));

    // Samples lie slightly inside the interval in which the viewers measure.
    const auto sleep_for = [](double s) {
        std::this_thread::sleep_for(seconds_to_duration(std::max(0.1, s)));
    };
    sleep_for(bench.warmup_seconds);
    const std::uint64_t dropped_before = dropped_by_host(link);
    sleep_for(0.5);
    const UsageSample before(host, viewers);
    sleep_for(bench.seconds - 0.7);
    const UsageSample after(host, viewers);

    double fps_min = 1e9, mbit = 0, p50 = 0, p99 = 0, max = 0, memory = 0, frames = 0;
    std::uint64_t dropped = 0;
    for (const auto& viewer : viewers) {
        const auto figures = nlohmann::json::parse(viewer->read_line(), nullptr, false);
        const ChildProcess::End end = viewer->wait();
        if (end.exit_code != 0 || !figures.is_object())
            throw Error("A viewer failed; its message is above.");
        for (const auto& camera : figures["cameras"])
            frames += camera["frames"].get<double>();
        for (const auto& camera : figures["cameras"])
            fps_min = std::min(fps_min, camera["frames"].get<double>() / bench.seconds);
        mbit += figures["mbit_per_s"].get<double>();
        p50 = std::max(p50, figures["age_ms"]["p50"].get<double>());
        p99 = std::max(p99, figures["age_ms"]["p99"].get<double>());
        max = std::max(max, figures["age_ms"]["max"].get<double>());
        dropped += figures["dropped"].get<std::uint64_t>();
        memory = std::max(memory, end.peak_memory_mb);
    }
    dropped += dropped_by_host(link) - dropped_before;
    host.interrupt();
    const ChildProcess::End host_end = host.wait();
    const auto report = nlohmann::json::parse(std::ifstream(summary_file), nullptr, false);
    if (!report.is_object())
        throw Error("The host left no report.");

    const double cameras = double(bench.cameras.size());
    double offered = 0;
    for (const auto& camera : report["cameras"])
        offered += camera["fps"].get<double>();
    const double carried =
        offered > 0 ? std::min(1.0, frames / bench.seconds / bench.viewers / offered) : 0;
    const nlohmann::json load = capacity(before, after, cameras * carried);
    // Host and viewers together, for each frame of a camera that a viewer decoded.
    const double frames_per_s = std::max(frames / bench.seconds / bench.viewers, 1.0);
    const double frame_cpu_ms = load["cores"].get<double>() * 1000 / frames_per_s;
    const double yardstick = (yardstick_before + yardstick_ms()) / 2;
    double viewer_growth = 0;
    for (std::size_t i = 0; i < viewers.size(); ++i)
        viewer_growth =
            std::max(viewer_growth, after.viewers[i].memory_mb - before.viewers[i].memory_mb);
    return {{"cameras", bench.cameras.size()},
            {"viewers", bench.viewers},
            {"seconds", bench.seconds},
            {"depth_codec", bench.depth_codec},
            {"color_codec", bench.color_codec},
            {"stages", slowest_stages(report)},
            {"fps_min", fps_min},
            {"frames_dropped", dropped},
            {"mbit_per_camera", mbit / cameras / bench.viewers},
            {"target", cli::instruction_set_in_use()},
            {"cpu_cores", load["cores"]},
            {"host_cores", load["host"]},
            {"viewer_cores", load["viewer"]},
            {"frames_per_viewer", frames / bench.viewers},
            {"frame_cpu_ms", frame_cpu_ms},
            {"frame_cpu_of_zstd1", frame_cpu_ms / yardstick},
            {"cpu_cores_here", load["cores_here"]},
            {"cpu_cores_of_others", load["others"]},
            {"cpu_shares", load["shares"]},
            {"cameras_possible", load["cameras_possible"]},
            {"ends_first", load["ends_first"]},
            {"costliest_stage", costliest_stage(report)},
            {"memory_growth_mb", after.host.memory_mb - before.host.memory_mb},
            {"viewer_memory_growth_mb", viewer_growth},
            {"filter", bench.filter},
            {"yardstick_ms", yardstick},
            {"host_memory_mb", host_end.peak_memory_mb},
            {"viewer_memory_mb", memory},
            {"age_ms", {{"p50", p50}, {"p99", p99}, {"max", max}}}};
}

}  // namespace theatron::bench
