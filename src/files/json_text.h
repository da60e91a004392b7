// SPDX-License-Identifier: Apache-2.0
// JSON as text, for values that contain names of files and people in any encoding.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace theatron::files {

// Bytes that are not UTF-8 become U+FFFD. `indent` as in nlohmann::json::dump().
inline std::string json_text(const nlohmann::json& json, int indent = -1) {
    return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace theatron::files
