// SPDX-License-Identifier: Apache-2.0
// Fields of JSON that another program has sent: any of them may be missing or of another type.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace theatron::files {

// Empty where there is no such text.
inline std::string text_field(const nlohmann::json& from, const char* field) {
    return from.contains(field) && from[field].is_string() ? from[field].get<std::string>()
                                                           : std::string();
}
// 0 where there is no such number.
inline double number_field(const nlohmann::json& from, const char* field) {
    return from.contains(field) && from[field].is_number() ? from[field].get<double>() : 0.0;
}
// False where there is no such value.
inline bool is_field_set(const nlohmann::json& from, const char* field) {
    return from.contains(field) && from[field].is_boolean() && from[field].get<bool>();
}
// Empty where there is no such list.
inline nlohmann::json list_field(const nlohmann::json& from, const char* field) {
    return from.contains(field) && from[field].is_array() ? from[field] : nlohmann::json::array();
}

}  // namespace theatron::files
