// SPDX-License-Identifier: Apache-2.0
// theatron_bench: benchmarks, started by `theatron bench`.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <string>

#include "base/error.h"
#include "bench_commands.h"
#include "capture/mkv_reader.h"
#include "cli/instruction_set.h"
#include "cli/program_frame.h"
#include "ffmpeg/ffmpeg.h"

namespace {

int run(int argc, char** argv) {
    // Yardsticks call it; this program is linked with FFmpeg for further functions anyway.
    theatron::ffmpeg::load_if_there();
    CLI::App app("Measure codecs, filters, renderers and the whole way of a frame",
                 "theatron bench");
    app.footer(std::string(theatron::cli::instruction_set_variable) +
               "=NAME in the environment holds the vector kernels to an instruction set of this "
               "machine: " +
               theatron::cli::known_instruction_sets() + ".");
    app.require_subcommand(1);
    theatron::bench::add_benchmarks(app);
    const auto known = app.get_subcommands({});
    if (argc > 1 && argv[1][0] != '-' &&
        std::none_of(known.begin(), known.end(),
                     [&](const CLI::App* one) { return one->check_name(argv[1]); }))
        throw theatron::Error("There is no benchmark '" + std::string(argv[1]) +
                              "'; 'theatron bench --help' lists them.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    theatron::cli::run_program(argc, argv,
                               {std::begin(theatron::capture::foreign_readers),
                                std::end(theatron::capture::foreign_readers)},
                               [&] { return run(argc, argv); });
}
