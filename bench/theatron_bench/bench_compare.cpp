// SPDX-License-Identifier: Apache-2.0
#include "bench_compare.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/bytes.h"
#include "bench_report.h"
#include "cli/number_check.h"
#include "cli/progress.h"
#include "compare_measure.h"
#include "compare_output.h"
#include "compare_page.h"
#include "files/file_bytes.h"

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
    require_outputs({flags.json, flags.page});
    const Compared compared = measure_compare(options, cli::show_progress());
    if (!flags.page.empty())
        files::write_file(flags.page, as_bytes(compare_page(compared)));
    report(compare_json(compared), flags.json,
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
        ->check(cli::number_from_to(0.1, 10'000));
    command->add_option("--latency-ms", flags->latency_ms, "Their delay, one way")
        ->capture_default_str()
        ->check(cli::number_from_to(0, 2000));
    command->add_flag("--quick", flags->options.scene.quick,
                      "A coarse room, small pictures, few of them: whether all works; says little");
    command->add_option(
        "--page", flags->page,
        "Write a page with the pictures to this file, HTML that needs no other file");
    add_json_option(*command, flags->json);
    command->callback([flags] { run_compare(*flags); });
}

}  // namespace theatron::bench
