// SPDX-License-Identifier: Apache-2.0
// The running time of a command, as an option of several commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/number_check.h"

namespace theatron::cli {

// Three years: longer than anything runs, and well within a clock's range.
inline constexpr double longest_seconds = 1e8;

// Adds the option --seconds, or `name`, which sets `seconds`; values of 0 and below are refused.
inline CLI::Option* add_seconds_option(CLI::App& command, double& seconds, const std::string& help,
                                       const char* name = "--seconds") {
    return command.add_option(name, seconds, help)
        ->check(number_check([](double value) { return value > 0 && value <= longest_seconds; },
                             "is not a number of seconds greater than 0 and up to 1e8"));
}

}  // namespace theatron::cli
