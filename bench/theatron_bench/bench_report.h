// SPDX-License-Identifier: Apache-2.0
// The output of every benchmark.
#pragma once

#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace CLI {
class App;
}

namespace theatron::bench {

// Prints a result as a table and, unless `file` is empty, writes it there as JSON. For "-" it
// prints JSON instead of the table. Throws Error.
void report(const nlohmann::json& result, const std::string& file,
            const std::function<void()>& print_table);

// The option --json, whose value is report()'s `file`.
void add_json_option(CLI::App& command, std::string& file);

// Before a measurement: throws Error where one of these files cannot be written, so that this is
// told now and not after minutes. Empty names and "-" are left out.
void require_outputs(std::initializer_list<std::string> files);

}  // namespace theatron::bench
