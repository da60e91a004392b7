// SPDX-License-Identifier: Apache-2.0
// The program's commands. Each adds itself to the command line; its callback
// does the work and throws Error with one sentence if that cannot be done.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace theatron::app {

// A command did what it could, but parts of the recording are damaged.
inline constexpr int damaged_exit_code = 3;

// `further`: the words of each session after the first (session_flags.h). `given`: the words of the
// command line, without those of a configuration (host_config.h).
void add_host_command(CLI::App& app, std::vector<std::vector<std::string>> further,
                      std::vector<std::string> given);
void add_session_command(CLI::App& app);
void add_link_command(CLI::App& app);
void add_certificate_command(CLI::App& app);
void add_join_command(CLI::App& app);
void add_publish_command(CLI::App& app);
void add_relay_command(CLI::App& app);
void add_record_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_recover_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_demo_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_cameras_command(CLI::App& app);
void add_lobby_command(CLI::App& app);
void add_status_command(CLI::App& app);
void add_background_command(CLI::App& app);
void add_case_command(CLI::App& app);
void add_target_command(CLI::App& app);
void add_register_command(CLI::App& app);
void add_photon_command(CLI::App& app);
void add_face_command(CLI::App& app);
void add_study_command(CLI::App& app);

}  // namespace theatron::app
