// SPDX-License-Identifier: Apache-2.0
// How every benchmark hands over its result.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace theatron::bench {

// Prints a result as a table, and writes it to `file` too unless that is empty; or, for "-",
// prints it as JSON instead. Throws Error.
void report(const nlohmann::json& result, const std::string& file,
            const std::function<void()>& print_table);

}  // namespace theatron::bench
