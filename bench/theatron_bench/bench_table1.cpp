// SPDX-License-Identifier: Apache-2.0
#include "bench_table1.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/bytes.h"
#include "base/error.h"
#include "bench_report.h"
#include "cli/camera_option.h"
#include "cli/progress.h"
#include "files/file_bytes.h"
#include "table1_measure.h"
#include "table1_output.h"
#include "table1_page.h"

namespace theatron::bench {
namespace {

struct Table1Flags {
    Table1Options options;
    bool quick = false;
    std::string json, csv, page;
};

void write(const std::string& file, const std::string& text) {
    if (!file.empty())
        files::write_file(file, as_bytes(text));
}

std::vector<std::string> generated_room(bool quick) {
    const std::string room = std::string("synthetic:room,seconds=2,") +
                             (quick ? "quality=quick,color=depth," : "") + "camera=";
    return {room + "0", room + "1"};
}

void run(Table1Flags flags) {
    Table1Options& options = flags.options;
    if (options.cameras.size() > 2)
        throw Error("The table has rows of one and of two cameras: give --camera at most twice.");
    if (options.cameras.empty())
        options.cameras = generated_room(flags.quick);
    if (flags.quick)
        make_quick(options);
    require_outputs({flags.json, flags.csv, flags.page});
    const Table1Measured measured = measure_table1(options, cli::show_progress());
    const std::vector<Table1Row> rows = table1_rows(measured);
    write(flags.csv, table1_csv(rows));
    write(flags.page, table1_page(measured, rows));
    report(table1_json(measured, rows), flags.json,
           [&] { std::fputs(table1_text(measured, rows).c_str(), stdout); });
}

}  // namespace

void add_table1_bench(CLI::App& bench) {
    const auto flags = std::make_shared<Table1Flags>();
    CLI::App* command = bench.add_subcommand(
        "table1", "Table 1 of Fischer et al. 2022, row by row, beside this machine's figures");
    command->footer(
        "Without --camera, two cameras of the generated operating room; making their pictures "
        "takes "
        "a minute the first time. All of it takes less than ten minutes on two cores.\n"
        "Example: theatron bench table1 --page table1.html --json table1.json\n"
        "Example: theatron bench table1 --camera recording:FILE --camera recording:FILE,camera=1");
    cli::add_camera_option(*command, flags->options.cameras,
                           "A camera or recording, kind:value,key=value; once more for the second "
                           "one of the rows with two cameras");
    command->add_option("--frames", flags->options.frames, "Most pictures of each")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_option("--runs", flags->options.runs, "Repetitions, for the spread")
        ->capture_default_str()
        ->check(CLI::Range(1, 100));
    command->add_flag("--quick", flags->quick,
                      "One run of small inputs: whether all works, in a minute; says little of "
                      "times");
    command->add_option("--csv", flags->csv, "Write the rows to this file as CSV");
    command->add_option("--page", flags->page,
                        "Write a page with plots to this file, HTML that needs no other file");
    add_json_option(*command, flags->json);
    command->callback([flags] { run(*flags); });
}

}  // namespace theatron::bench
