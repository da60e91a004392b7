// SPDX-License-Identifier: Apache-2.0
// The options of commands that show a session in a window or draw it into files.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "join_flags.h"

namespace theatron::app {

// "a, b, c".
std::string join_names(const std::vector<std::string>& names);

// The code of a language (phrases/language.h); `language` must outlive `command`.
void add_language_option(CLI::App& command, std::string& language);

// `flags` must outlive `command`.
void add_picture_options(CLI::App& command, JoinFlags& flags);

// Fills JoinFlags::given once the command line is parsed.
void note_given(const CLI::App& command, JoinFlags& flags);

}  // namespace theatron::app
