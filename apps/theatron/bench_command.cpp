// SPDX-License-Identifier: Apache-2.0
// theatron bench: starts theatron_bench, which lies beside this program, so that the libraries it
// measures against are not loaded in an operating room.
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/error.h"
#include "commands.h"

namespace theatron::app {

void add_bench_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "bench", "Measure codecs, filters, renderers and the whole way of a frame");
    command->prefix_command();
    command->set_help_flag();  // theatron_bench has the help
    command->callback([command] {
        const std::filesystem::path program =
            std::filesystem::read_symlink("/proc/self/exe").parent_path() / "theatron_bench";
        std::vector<std::string> words = command->remaining();
        words.insert(words.begin(), program.string());
        std::vector<char*> arguments;
        arguments.reserve(words.size() + 1);
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execv(program.c_str(), arguments.data());
        throw Error(
            "Cannot start " + program.string() +
            (errno == ENOENT ? ", which is not installed; build it with `make build`." : "."));
    });
}

}  // namespace theatron::app
