// SPDX-License-Identifier: Apache-2.0
#include "bench_compare.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "bench_report.h"
#include "cli/progress.h"
#include "compare_measure.h"
#include "compare_output.h"
#include "compare_page.h"
#include "files/file_bytes.h"
#include "files/json_text.h"

namespace theatron::bench {
namespace {

struct CompareFlags {
    CompareOptions options;
    std::vector<double> mbit = {20, 100};
    double latency_ms = 20;
    std::string json, page;
};

void run_compare(const CompareFlags& flags) {
    CompareOptions options = flags.options;
    if (options.scene.quick) {
        options.scene.frames = std::min(options.scene.frames, 4);
        options.scene.picture = {320, 180};
    }
    options.links.clear();
    for (const double mbit : flags.mbit)
        options.links.push_back({mbit, flags.latency_ms});
    const bool json_file = !flags.json.empty() && flags.json != "-";
    for (const std::string& file : {json_file ? flags.json : std::string(), flags.page})
        if (!file.empty())
            files::require_writable(file);
    const Compared compared = measure_compare(options, cli::show_progress());
    const nlohmann::json json = compare_json(compared);
    if (!flags.page.empty())
        files::write_file(flags.page, as_bytes(compare_page(compared)));
    if (json_file)
        files::write_file(flags.json, as_bytes(files::json_text(json, 2) + "\n"));
    report(json, flags.json == "-" ? "-" : "",
           [&] { std::fputs(compare_text(compared).c_str(), stdout); });
}

}  // namespace

void add_compare_bench(CLI::App& bench) {
    const auto flags = std::make_shared<CompareFlags>();
    CLI::App* command = bench.add_subcommand(
        "compare",
        "Theatron beside a video call, a published pipeline and a general point cloud codec");
    command->footer(
        "All of them send the same second of the generated operating room. The page has their "
        "pictures side by side, what they cost, and what the figures do not say. Takes some "
        "minutes on two cores.\n"
        "Example: theatron bench compare --page compare.html\n"
        "Example: theatron bench compare --cameras 4 --mbit 50 --latency-ms 40 --json "
        "compare.json\n"
        "Example: theatron bench compare --quick --page compare.html    (whether all works, in "
        "seconds)");
    command->add_option("--cameras", flags->options.scene.cameras, "Generated cameras")
        ->capture_default_str()
        ->check(CLI::Range(1, 4));
    command->add_option("--frames", flags->options.scene.frames, "Pictures of each")
        ->capture_default_str()
        ->check(CLI::Range(2, 300));
    command
        ->add_option("--mbit", flags->mbit,
                     "Rates of the simulated lines, separated by blanks, Mbit/s")
        ->capture_default_str()
        ->check(CLI::Range(0.1, 10000.0));
    command->add_option("--latency-ms", flags->latency_ms, "Their delay, one way")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 2000.0));
    command->add_flag("--quick", flags->options.scene.quick,
                      "A coarse room, small pictures, few of them: whether all works; says little");
    command->add_option(
        "--page", flags->page,
        "Write a page with the pictures to this file, HTML that needs no other file");
    command->add_option("--json", flags->json,
                        "Write the result to this file; - prints it instead of the table");
    command->callback([flags] { run_compare(*flags); });
}

}  // namespace theatron::bench
