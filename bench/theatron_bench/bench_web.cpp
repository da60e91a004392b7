// SPDX-License-Identifier: Apache-2.0
#include "bench_web.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/statistics.h"
#include "base/steady_clock.h"
#include "bench_report.h"
#include "bench_web_decoding.h"
#include "browser_page.h"
#include "child_process.h"
#include "cli/camera_option.h"
#include "cli/number_check.h"
#include "client/participant.h"

namespace theatron::bench {
namespace {

using client::Participant;
using nlohmann::json;

constexpr Duration patience = std::chrono::seconds(60);

// Runs before the page's own scripts.
constexpr const char* watch_tasks = R"js(
globalThis.longest_task_ms = 0;
new PerformanceObserver(list => {
    for (const { duration } of list.getEntries())
        globalThis.longest_task_ms = Math.max(globalThis.longest_task_ms, duration);
}).observe({ type: "longtask", buffered: true });
)js";

constexpr const char* enter = R"js(
new Promise(entered => {
    const attempt = () => {
        if (!document.getElementById("invitation")?.textContent)
            return setTimeout(attempt, 5);
        document.getElementById("name").value = "page";
        document.getElementById("enter").click();
        entered();
    };
    attempt();
}))js";

constexpr const char* state = "JSON.parse(JSON.stringify(theatron.state))";

// A host on this machine, with a folder for its state.
struct Host {
    explicit Host(const std::vector<std::string>& cameras) {
        std::string path =
            (std::filesystem::temp_directory_path() / "theatron_bench_web_XXXXXX").string();
        if (!mkdtemp(path.data()))
            throw Error("No folder can be made at '" + path + "'.");
        folder = path;
        std::vector<std::string> arguments = {"host",   "--listen", "127.0.0.1:0",
                                              "--json", "--state",  folder};
        for (const std::string& camera : cameras)
            arguments.insert(arguments.end(), {"--camera", camera});
        process = std::make_unique<ChildProcess>(arguments);
        const auto greeting = json::parse(process->read_line(), nullptr, false);
        if (!greeting.is_object())
            throw Error("The host did not start; its message is above.");
        link = greeting["link"].get<std::string>();
    }
    ~Host() {
        process.reset();
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }

    std::string folder, link;
    std::unique_ptr<ChildProcess> process;
};

constexpr std::array age_keys{"p50", "p95", "p99"};

// The oldest of the cameras decides.
json ages_of(const Participant& native) {
    double p50 = 0, p95 = 0, p99 = 0;
    for (const receive::StreamFigures& figures : native.figures())
        if (is_depth(figures.stream)) {
            p50 = std::max(p50, figures.age_p50_ms);
            p95 = std::max(p95, figures.age_p95_ms);
            p99 = std::max(p99, figures.age_p99_ms);
        }
    return {{"p50", p50}, {"p95", p95}, {"p99", p99}};
}

json ages_of(const json& cameras) {
    json ages;
    for (const std::string key : age_keys) {
        double oldest = 0;
        for (const json& camera : cameras)
            // Null where no frame came.
            if (const json& age = camera["age_" + key + "_ms"]; age.is_number())
                oldest = std::max(oldest, age.get<double>());
        ages[key] = oldest;
    }
    return ages;
}

json measure(const WebBench& bench, const std::string& link, const std::string& chromium) {
    BrowserPage page(chromium, bench.size, watch_tasks);
    page.open(link + (bench.decoding.empty() ? "" : "&decoding=" + bench.decoding) +
              (bench.color.empty() ? "" : "&color=" + bench.color));
    page.wait_for("location.protocol === 'https:'", patience);
    page.evaluate(enter);
    page.wait_for("theatron.complete_ms !== null", patience);
    json r{{"first_picture_s", page.evaluate("theatron.complete_ms").get<double>() / 1000},
           {"transferred_bytes", page.transferred_bytes()}};

    Participant::Options options;
    options.link = net::parse_link(link);
    options.name = "native";
    Participant native(std::move(options));
    std::this_thread::sleep_for(2s);
    r["longest_loading_task_ms"] = page.evaluate(
        "const ms = longest_task_ms; longest_task_ms = 0; theatron.reset_figures(); ms");
    native.reset_figures();
    std::this_thread::sleep_for(1s);  // figures are made ten times a second
    const json first = page.evaluate(state);
    const TimePoint begin = steady_now();
    std::this_thread::sleep_for(seconds_to_duration(bench.seconds));
    const json last = page.evaluate(state);
    const double seconds = to_seconds(steady_now() - begin);

    r["cameras"] = last["cameras"].size();
    r["decoders"] = last["decoders"];
    r["renderer"] = last["renderer"];
    double fps_min = 1e9, color_fps_min = 1e9, dropped = 0, mbit_per_s = 0, color_decode_ms = 0;
    for (std::size_t i = 0; i < last["cameras"].size(); ++i) {
        const json &before = first["cameras"].at(i), &after = last["cameras"][i];
        const auto grown = [&](const char* key) {
            return after[key].get<double>() - before[key].get<double>();
        };
        fps_min = std::min(fps_min, grown("depth_frames") / seconds);
        color_fps_min = std::min(color_fps_min, grown("color_frames") / seconds);
        dropped += grown("dropped");
        mbit_per_s += after["mbit_per_second"].get<double>();
        color_decode_ms = std::max(color_decode_ms, after["color_decode_ms"].get<double>());
    }
    r["fps_min"] = fps_min;
    r["color_fps_min"] = color_fps_min;
    r["color"] = last["cameras"].empty() ? json("") : last["cameras"][0]["color"];
    r["color_reason"] = last["color"]["reason"];
    r["color_decode_ms"] = color_decode_ms;
    r["mbit_per_s"] = mbit_per_s;
    r["dropped"] = dropped;
    r["pictures_per_s"] =
        (last["pictures"].get<double>() - first["pictures"].get<double>()) / seconds;
    r["age_ms"] = ages_of(last["cameras"]);
    r["native_age_ms"] = ages_of(native);
    for (const char* key : age_keys)
        r["age_over_native_ms"][key] =
            r["age_ms"][key].get<double>() - r["native_age_ms"][key].get<double>();
    r["longest_task_ms"] = page.evaluate("longest_task_ms");
    r.update(time_strata(page));
    r["problems"] = page.problems();
    return r;
}

// Medians of numbers; of anything else, that of the first run.
json median_of(const std::vector<json>& runs) {
    if (runs.front().is_object()) {
        json result;
        for (const auto& [key, value] : runs.front().items()) {
            std::vector<json> values;
            for (const json& run : runs)
                values.push_back(run.at(key));
            result[key] = median_of(values);
        }
        return result;
    }
    if (!runs.front().is_number())
        return runs.front();
    std::vector<double> values;
    for (const json& run : runs)
        values.push_back(run.get<double>());
    return median(values);
}

}  // namespace

nlohmann::json bench_web(const WebBench& bench, const std::string& chromium) {
    std::vector<std::string> cameras = bench.cameras;
    for (int i = 0; bench.cameras.empty() && i < 2; ++i)
        cameras.push_back("synthetic:seconds=2,fps=30,loop=1,preload=1," +
                          std::string(bench.full ? "color=depth" : "quality=quick") +
                          ",camera=" + std::to_string(i));
    const Host host(cameras);
    std::vector<json> runs;
    for (int i = 0; i < bench.runs; ++i)
        runs.push_back(measure(bench, host.link, chromium));
    json result = median_of(runs);
    result["runs"] = bench.runs;
    result["size"] = std::to_string(bench.size.width) + "x" + std::to_string(bench.size.height);
    return result;
}

void add_web_bench(CLI::App& bench) {
    struct Flags {
        WebBench bench;
        std::string size, json;
    };
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = bench.add_subcommand(
        "web", "The browser client in Chromium: first picture, frames, age beside a native client");
    command->footer("Example: theatron bench web --full --json -");
    cli::add_camera_option(*command, flags->bench.cameras);
    command->add_option("--seconds", flags->bench.seconds, "Measured time of each run")
        ->capture_default_str()
        ->check(cli::number_from_to(1.0, 3600.0));
    command->add_option("--runs", flags->bench.runs, "Each with an empty cache")
        ->capture_default_str()
        ->check(CLI::Range(1, 100));
    command->add_option("--size", flags->size,
                        "Pixels of the page: WIDTHxHEIGHT [1280x720; with --full 640x360]");
    command->add_flag("--full", flags->bench.full,
                      "Generated cameras with depth and colour of 640x576 instead of quick ones");
    command->add_option("--decoding", flags->bench.decoding, "page: without decoding workers")
        ->check(CLI::IsMember({"page"}));
    command->add_option("--color", flags->bench.color,
                        "The codec of colour that the page asks for; by itself if empty");
    add_json_option(*command, flags->json);
    command->callback([flags] {
        Size& size = flags->bench.size;
        if (flags->bench.full && !flags->bench.cameras.empty())
            throw Error("--full is for generated cameras; leave out --camera.");
        if (flags->size.empty())
            flags->size = flags->bench.full ? "640x360" : "1280x720";
        if (std::sscanf(flags->size.c_str(), "%dx%d", &size.width, &size.height) != 2 ||
            size.width < 100 || size.height < 100 || size.width > 8192 || size.height > 8192)
            throw Error("'" + flags->size + "' is no size of a page; say for example 1280x720.");
        const auto chromium = find_chromium();
        if (!chromium) {
            std::fprintf(stderr,
                         "theatron: Chromium is not installed, so nothing was measured; install it "
                         "with: apt-get install chromium\n");
            return;
        }
        const json r = bench_web(flags->bench, *chromium);
        report(r, flags->json, [&] {
            const auto number = [&](const char* key) { return r[key].get<double>(); };
            std::printf("first complete picture   %8.2f s\n", number("first_picture_s"));
            std::printf("page and program         %8.0f kB\n", number("transferred_bytes") / 1000);
            std::printf("decoded, slowest camera  %8.1f frames a second, %.0f dropped\n",
                        number("fps_min"), number("dropped"));
            std::printf("colour                   %8.1f frames a second, %.1f ms each (%s)\n",
                        number("color_fps_min"), number("color_decode_ms"),
                        r["color"].get<std::string>().c_str());
            std::printf("data                     %8.1f Mbit/s\n", number("mbit_per_s"));
            std::printf("drawn                    %8.1f pictures a second\n",
                        number("pictures_per_s"));
            const auto& ages = r["age_over_native_ms"];
            std::printf("age beyond native        %8.1f ms (p50), %.1f ms (p95), %.1f ms (p99)\n",
                        ages["p50"].get<double>(), ages["p95"].get<double>(),
                        ages["p99"].get<double>());
            std::printf("longest task             %8.0f ms, %.0f ms while loading\n",
                        number("longest_task_ms"), number("longest_loading_task_ms"));
            std::printf("Strata, a key frame      %8.1f ms, %.2f times native SSE4\n",
                        number("strata_decode_ms"), number("strata_decode_over_native_sse4"));
        });
    });
}

}  // namespace theatron::bench
