// SPDX-License-Identifier: Apache-2.0
// theatron bench filter
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "bench_filter.h"
#include "bench_report.h"
#include "bench_sequence.h"
#include "cli/progress.h"
#include "host/filter_choice.h"

namespace theatron::bench {
namespace {

struct FilterFlags {
    std::string folder;
    std::string json;
    int frames = 30;
    bool quality = false;
    bool room = false;
    bool stereo = false;
    std::vector<std::string> filters;
};

void print_times(const nlohmann::json& result) {
    std::printf("%dx%d, one thread, %s\n", result["width"].get<int>(), result["height"].get<int>(),
                result["target"].get<std::string>().c_str());
    for (const auto& stage : result["stages"])
        std::printf("  %-32s %-10s %8.3f ms\n", stage["name"].get<std::string>().c_str(),
                    stage["variant"].get<std::string>().c_str(), stage["ms"].get<double>());
    for (const auto& chain : result["chain"]) {
        std::printf("  chain %-37s %8.3f ms", chain["variant"].get<std::string>().c_str(),
                    chain["ms"].get<double>());
        if (chain.contains("of_zstd1"))
            std::printf("  %.3f of zstd level 1 (%.3f ms)", chain["of_zstd1"].get<double>(),
                        chain["zstd1_ms"].get<double>());
        std::printf("\n");
    }
}

void print_quality(const nlohmann::json& chains) {
    for (const auto& chain : chains) {
        std::printf("%s  (%s)\n", chain["name"].get<std::string>().c_str(),
                    chain["filters"].get<std::string>().c_str());
        for (const auto& s : chain["scenes"])
            std::printf(
                "  %-15s sigma %5.2f mm (cut %4.1f)  RMSE %5.2f mm  valid %5.1f %%  flips %5.2f %% "
                " "
                "flying %5.2f %%  ghosts %5.2f %%  holes %5.1f %% +- %4.1f mm  %6.2f Mbit/s\n",
                s["scene"].get<std::string>().c_str(), s["temporal_sigma_mm"].get<double>(),
                s["temporal_sigma_cut"].get<double>(), s["rmse_mm"].get<double>(),
                100 * s["valid"].get<double>(), 100 * s["flips"].get<double>(),
                100 * s["flying"].get<double>(), 100 * s["ghosts"].get<double>(),
                100 * s["holes_filled"].get<double>(), s["holes_error_mm"].get<double>(),
                s["depth_mbit_per_second"].get<double>());
        if (!chain.contains("moving_boards"))
            continue;
        std::printf("  boards that move: mean bias %.2f mm;",
                    chain["moving_boards"]["mean_bias_mm"].get<double>());
        for (const auto& b : chain["moving_boards"]["speeds"])
            std::printf(" %.0f mm/s %+.2f", b["mm_per_second"].get<double>(),
                        b["bias_mm"].get<double>());
        const auto& crossing = chain["crossing_board"];
        std::printf("\n  board that crosses: ghosts %.2f %%;",
                    100 * crossing["ghosts"].get<double>());
        for (const auto& c : crossing["speeds"])
            std::printf(" %.0f px/frame: lag %+.2f, %+.2f frames, edge %.1f px;",
                        c["pixels_per_frame"].get<double>(), c["leading_lag_frames"].get<double>(),
                        c["trailing_lag_frames"].get<double>(),
                        c["edge_width_pixels"].get<double>());
        std::printf("\n");
    }
}

nlohmann::json quality_of(const FilterFlags& flags) {
    nlohmann::json chains = nlohmann::json::array();
    std::optional<FilterClip> room;
    if (flags.room && flags.stereo)
        throw Error("The operating room is seen by a time-of-flight camera: leave out --stereo.");
    if (flags.room)
        room = operating_room_clip(60, cli::show_progress());
    for (const std::string& name : flags.filters) {
        const host::LoadedFilter loaded = host::FilterSource(name).load();
        const bool recorded = loaded.background != nullptr;
        if (recorded && !room)
            throw Error("A recorded background is of one scene: it goes with --room.");
        // A recorded background belongs to the operating room, so other scenes are left out.
        nlohmann::json chain = recorded ? nlohmann::json{{"filters", loaded.settings.spelling()},
                                                         {"scenes", nlohmann::json::array()}}
                                        : filter_quality(loaded.settings, flags.stereo);
        chain["name"] = name;
        if (room)
            chain["scenes"].push_back(
                filter_quality_of_clip(loaded.settings, *room, loaded.background.get()));
        chains.push_back(std::move(chain));
    }
    return chains;
}

void print_recorded(const nlohmann::json& chains) {
    for (const auto& chain : chains)
        for (const auto& s : chain["scenes"])
            std::printf(
                "%-24s %7.1f kB a frame  still pixels (%4.1f %%): sigma %5.2f mm, change %5.1f %%  "
                "all pixels: change %5.1f %%, flip %5.2f %%, valid %5.1f %%\n",
                chain["name"].get<std::string>().c_str(), s["kb_per_frame"].get<double>(),
                100 * s["still"].get<double>(), s["still_sigma_mm"].get<double>(),
                100 * s["still_changes"].get<double>(), 100 * s["changes"].get<double>(),
                100 * s["flips"].get<double>(), 100 * s["valid"].get<double>());
}

nlohmann::json recorded_quality_of(const FilterFlags& flags) {
    const BenchSequence sequence = load_sequence(flags.folder, false, flags.frames);
    nlohmann::json chains = nlohmann::json::array();
    for (const std::string& name : flags.filters) {
        const host::LoadedFilter loaded = host::FilterSource(name).load();
        if (loaded.background != nullptr)
            throw Error("A recorded background is of one scene: it goes with --room.");
        nlohmann::json chain =
            filter_quality_of_recording(loaded.settings, sequence.name, sequence.depth);
        chain["name"] = name;
        chains.push_back(std::move(chain));
    }
    return chains;
}

void run(const FilterFlags& flags) {
    if (flags.quality && !flags.folder.empty()) {
        const nlohmann::json chains = recorded_quality_of(flags);
        report(chains, flags.json, [&] { print_recorded(chains); });
        return;
    }
    if (flags.quality) {
        const nlohmann::json chains = quality_of(flags);
        report(chains, flags.json, [&] { print_quality(chains); });
        return;
    }
    const auto frames = [&]() -> std::vector<DepthImage> {
        if (!flags.folder.empty())
            return load_sequence(flags.folder, false, flags.frames).depth;
        if (flags.room)
            return operating_room_frames(flags.frames, cli::show_progress());
        return rocking_person(flags.frames).measured;
    };
    const nlohmann::json result = bench_filter(frames());
    report(result, flags.json, [&] { print_times(result); });
}

}  // namespace

void add_filter_bench(CLI::App& bench) {
    const auto flags = std::make_shared<FilterFlags>();
    CLI::App* command =
        bench.add_subcommand("filter", "Depth filters: speed, or quality; checked, one thread");
    command->add_option("folder", flags->folder,
                        "A folder with depth/*.png instead of a generated scene");
    command->add_option("--frames", flags->frames, "Number of frames")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    command->add_flag("--quality", flags->quality,
                      "Not the speed but what filters do to the truth of generated scenes, or to "
                      "the size and the flicker of the recorded frames in the folder");
    command->add_option("--filters", flags->filters, "With --quality: these chains")
        ->default_val(std::vector<std::string>{"off", "paper", "default"});
    command->add_flag(
        "--room", flags->room,
        "The operating room: with --quality, too; else instead of the generated person. It is "
        "rendered once, which takes minutes");
    command->add_flag("--stereo", flags->stereo,
                      "With --quality: the generated scenes as a stereo camera sees them");
    add_json_option(*command, flags->json);
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::bench
