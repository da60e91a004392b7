// SPDX-License-Identifier: Apache-2.0
// Checks of numbers in options. Those of CLI11 take "nan", which no comparison refuses.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

namespace theatron::cli {

// For CLI::Option::check(). `holds` is false for NaN if it compares with `<`, `>` and their like.
// `otherwise` follows the text that was given: "is not a number of hours from 0 to 1000".
inline std::function<std::string(std::string)> number_check(std::function<bool(double)> holds,
                                                            std::string otherwise) {
    return [holds = std::move(holds), otherwise = std::move(otherwise)](const std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && holds(value)
                   ? std::string()
                   : "'" + text + "' " + otherwise;
    };
}

// For CLI::Option::check(): a number from `least` to `most`.
inline std::function<std::string(std::string)> number_from_to(double least, double most) {
    const auto text = [](double value) {
        char digits[32] = {};
        std::snprintf(digits, sizeof digits, "%g", value);
        return std::string(digits);
    };
    return number_check([=](double value) { return value >= least && value <= most; },
                        "is not a number from " + text(least) + " to " + text(most));
}

}  // namespace theatron::cli
