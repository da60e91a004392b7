// SPDX-License-Identifier: Apache-2.0
// theatron: the command-line program.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "base/output.h"
#include "base/standard_streams.h"
#include "capture/mkv_reader.h"
#include "cases/foreign_files.h"
#include "cli/instruction_set.h"
#include "cli/output_end.h"
#include "commands.h"
#include "host_config.h"
#include "licences.h"
#include "link_argument.h"
#include "manual.h"
#include "session_flags.h"
#include "unknown_command.h"

namespace {

// Output may still be in a buffer or a queue, and writing it can fail.
int with_output_written(int code) {
    std::cout.flush();
    const bool is_flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout;
    if (theatron::cli::finish_output() && is_flushed)
        return code;
    theatron::output::print(
        "theatron: The output could not be written: its disk is full or its reader gone.\n",
        theatron::output::Stream::error);
    (void)theatron::cli::finish_output();
    return code != 0 ? code : 1;
}

int run(int argc, char** argv) {
    // At the file-size limit, writing then fails with an error instead of ending the process.
    std::signal(SIGXFSZ, SIG_IGN);
    theatron::cli::hold_to_instruction_set();
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
        return with_output_written(0);
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

// Says why the program fails, where it does.
int run_and_tell(int argc, char** argv) {
    int code = 1;
    try {
        return run(argc, argv);
    } catch (const theatron::app::ConfigError& e) {
        const std::vector<std::string> words(argv, argv + argc);
        if (std::find(words.begin(), words.end(), "--check-config") == words.end())
            code = theatron::app::config_exit_code;
        theatron::output::print(std::string("theatron: ") + e.what() + "\n",
                                theatron::output::Stream::error);
    } catch (const theatron::Error& e) {
        theatron::output::print(std::string("theatron: ") + e.what() + "\n",
                                theatron::output::Stream::error);
    } catch (const std::filesystem::filesystem_error& e) {
        theatron::output::print(
            "theatron: Cannot use '" + e.path1().string() + "': " + e.code().message() + ".\n",
            theatron::output::Stream::error);
    } catch (const std::exception& e) {
        theatron::output::print(
            std::string("theatron: something unexpected went wrong: ") + e.what() + "\n",
            theatron::output::Stream::error);
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    theatron::reserve_standard_streams();
    std::vector<theatron::sandbox::Reader> readers(std::begin(theatron::capture::foreign_readers),
                                                   std::end(theatron::capture::foreign_readers));
    readers.insert(readers.end(), std::begin(theatron::cases::foreign_readers),
                   std::end(theatron::cases::foreign_readers));
    theatron::sandbox::run_as_child(argc, argv, readers);
    theatron::cli::outlive_readers();
    theatron::log::flush_before_abort();
    const int code = with_output_written(run_and_tell(argc, argv));
    // Without what exit() runs: threads that nobody waits for may still be in a library or the
    // system.
    std::_Exit(code);
}
