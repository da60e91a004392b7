// SPDX-License-Identifier: Apache-2.0
// theatron: the command-line program.
#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/output.h"
#include "cli/program_frame.h"
#include "commands.h"
#include "foreign_readers.h"
#include "host_config.h"
#include "licences.h"
#include "link_argument.h"
#include "manual.h"
#include "session_flags.h"
#include "unknown_command.h"

namespace {

int run(int argc, char** argv) {
    CLI::App app(
        "Theatron: open telepresence for the operating room.\n\n"
        "A host streams its RGB-D cameras; others join with the link that it prints:\n"
        "  theatron host --camera folder:DIR,loop=1\n"
        "  theatron join 'https://HOST:PORT/#join=...&cert=...' --offscreen view.png --seconds 3\n"
        "  theatron demo");
    app.require_subcommand(1);
    app.set_version_flag("--version", THEATRON_VERSION);
    app.add_flag_callback(
        "--licences", [] { throw CLI::CallForVersion(std::string(theatron::app::licences()), 0); },
        "Print the licence of Theatron, and the notices of the works that it contains");
    // For the build, which installs what it writes (cmake/TheatronInstall.cmake).
    app.add_option_function<std::string>("--write-manual",
                                         [&app](const std::string& folder) {
                                             theatron::app::write_manual(app, THEATRON_VERSION,
                                                                         folder);
                                             throw CLI::Success();
                                         })
        ->group("");
    const std::vector<std::string> given = theatron::app::take_arguments(argc, argv);
    if (const auto problem = theatron::app::empty_argument(given); !problem.empty())
        throw theatron::Error(problem);
    std::vector<std::string> arguments = given;
    theatron::app::PartedWords words{arguments, {}};
    if (argc > 1 && arguments[1] == "host") {
        arguments = theatron::app::with_config(arguments);
        words = theatron::app::part_sessions(arguments);
    }
    theatron::app::add_host_command(app, words.further, given);
    theatron::app::add_session_command(app);
    theatron::app::add_link_command(app);
    theatron::app::add_certificate_command(app);
    theatron::app::add_join_command(app);
    theatron::app::add_publish_command(app);
    theatron::app::add_relay_command(app);
    theatron::app::add_record_command(app);
    theatron::app::add_inspect_command(app);
    theatron::app::add_recover_command(app);
    theatron::app::add_export_command(app);
    theatron::app::add_bench_command(app);
    theatron::app::add_demo_command(app);
    theatron::app::add_view_command(app);
    theatron::app::add_cameras_command(app);
    theatron::app::add_lobby_command(app);
    theatron::app::add_status_command(app);
    theatron::app::add_background_command(app);
    theatron::app::add_case_command(app);
    theatron::app::add_target_command(app);
    theatron::app::add_register_command(app);
    theatron::app::add_photon_command(app);
    theatron::app::add_face_command(app);
    theatron::app::add_study_command(app);

    if (argc == 1) {
        std::cout << app.help();
        return 0;
    }
    const auto commands = app.get_subcommands({});
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CLI::App* command : commands)
        names.push_back(command->get_name());
    if (const auto problem = theatron::app::unknown_command(arguments[1], names); !problem.empty())
        throw theatron::Error(problem);
    std::vector<const char*> taken;
    taken.reserve(words.first.size());
    for (const std::string& argument : words.first)
        taken.push_back(argument.c_str());
    try {
        app.parse(int(taken.size()), taken.data());
    } catch (const CLI::ParseError& e) {
        const bool is_misread = dynamic_cast<const CLI::RequiredError*>(&e) ||
                                dynamic_cast<const CLI::ExtrasError*>(&e);
        if (const auto problem = theatron::app::file_taken_for_option(arguments);
            is_misread && !problem.empty())
            throw theatron::Error(problem);
        // The library names the words in reverse order.
        if (const auto unexpected = app.remaining(true);
            dynamic_cast<const CLI::ExtrasError*>(&e) && !unexpected.empty())
            throw theatron::Error("'" + unexpected.front() + "' is not expected here; 'theatron " +
                                  arguments[1] + " --help' tells what is.");
        // A command's own exit code is kept; those of the library for mistakes in options become 1.
        const int code = app.exit(e);
        return code == 0 || dynamic_cast<const CLI::RuntimeError*>(&e) ? code : 1;
    }
    return 0;
}

// A service manager does not start a program again whose configuration is wrong.
int run_with_code_of_configuration(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const theatron::app::ConfigError& e) {
        theatron::output::print(std::string("theatron: ") + e.what() + "\n",
                                theatron::output::Stream::error);
        const std::vector<std::string> words(argv, argv + argc);
        const bool is_check =
            std::find(words.begin(), words.end(), "--check-config") != words.end();
        return is_check ? 1 : theatron::app::config_exit_code;
    }
}

}  // namespace

int main(int argc, char** argv) {
    theatron::cli::run_program(argc, argv, theatron::app::foreign_readers(),
                               [&] { return run_with_code_of_configuration(argc, argv); });
}
