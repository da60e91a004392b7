// SPDX-License-Identifier: Apache-2.0
// theatron_demo: `theatron demo` without the other commands, so that `make demo` shows the first
// picture before they are compiled.
#include <filesystem>

#include "cli/program_frame.h"
#include "commands.h"
#include "foreign_readers.h"

namespace {

int run(int argc, char** argv) {
    // Commands to copy are those of the whole program.
    CLI::App app("Theatron: open telepresence for the operating room.",
                 std::filesystem::path(argv[0]).replace_filename("theatron").string());
    app.require_subcommand(1);
    theatron::app::add_demo_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 1;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    theatron::cli::run_program(argc, argv, theatron::app::foreign_readers(),
                               [&] { return run(argc, argv); });
}
