// SPDX-License-Identifier: Apache-2.0
// The running time of a command, as an option of several commands.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace theatron::cli {

// Three years: longer than anything runs, and well within a clock's range.
inline constexpr double longest_seconds = 1e8;

// Adds the option --seconds, or `name`, which sets `seconds`; values of 0 and below are refused.
inline CLI::Option* add_seconds_option(CLI::App& command, double& seconds, const std::string& help,
                                       const char* name = "--seconds") {
    return command.add_option(name, seconds, help)
        ->check([](const std::string& text) -> std::string {
            double value = 0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            if (is_number && std::isfinite(value) && value > 0 && value <= longest_seconds)
                return "";
            return "'" + text + "' is not a number of seconds greater than 0 and up to 1e8";
        });
}

}  // namespace theatron::cli
