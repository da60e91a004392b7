// SPDX-License-Identifier: Apache-2.0
// theatron bench filter
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "bench_filter.h"
#include "bench_sequence.h"

namespace theatron::app {
namespace {

struct Flags {
    std::string folder;
    std::string json;
    int frames = 30;
};

void write(const nlohmann::json& result, const std::string& file) {
    if (file.empty())
        return;
    std::ofstream out(file);
    out << result.dump(2) << "\n";
    if (!out.flush())
        throw Error("Cannot write " + file + ".");
}

void print_times(const nlohmann::json& result) {
    std::printf("%dx%d, one thread\n", result["width"].get<int>(), result["height"].get<int>());
    for (const auto& stage : result["stages"])
        std::printf("  %-32s %-10s %8.3f ms\n", stage["name"].get<std::string>().c_str(),
                    stage["variant"].get<std::string>().c_str(), stage["ms"].get<double>());
    for (const auto& chain : result["chain"])
        std::printf("  chain %-37s %8.3f ms\n", chain["variant"].get<std::string>().c_str(),
                    chain["ms"].get<double>());
}

void run(const Flags& flags) {
    const std::vector<DepthImage> frames =
        flags.folder.empty() ? rocking_person(flags.frames).measured
                             : load_sequence(flags.folder, false, flags.frames).depth;
    const nlohmann::json result = bench_filter(frames);
    if (flags.json == "-")
        std::cout << result.dump(2) << std::endl;
    else
        print_times(result);
    if (flags.json != "-")
        write(result, flags.json);
}

}  // namespace

void add_filter_bench(CLI::App& bench) {
    const auto flags = std::make_shared<Flags>();
    CLI::App* command = bench.add_subcommand("filter", "Depth filters: speed, checked, one thread");
    command->add_option("folder", flags->folder,
                        "A folder with depth/*.png instead of a generated scene");
    command->add_option("--frames", flags->frames, "So many frames")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    command->add_option("--json", flags->json,
                        "Write the result to this file; - prints it instead of the table");
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::app
