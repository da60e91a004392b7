// SPDX-License-Identifier: Apache-2.0
// Manual pages, and the completion of bash and zsh, written from the program's own commands and
// options: the build runs the program for them, so that they say what --help says.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace theatron::app {

// Manual page of section 1, roff. `command`: one of `app` (theatron-host.1), or `app` itself
// (theatron.1), which lists its commands.
std::string manual_page(const CLI::App& app, const CLI::App& command, const std::string& version);

// Files that a shell sources: commands, their options, and the values of options that have a list
// of them; elsewhere file names are completed.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);

// All of them: man1/*.1, theatron.bash and _theatron. Makes `folder`. Throws Error.
void write_manual(const CLI::App& app, const std::string& version,
                  const std::filesystem::path& folder);

}  // namespace theatron::app
