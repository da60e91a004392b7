// SPDX-License-Identifier: Apache-2.0
// Fields of a lobby that a host has sent: any of them may be missing or of another type.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace theatron::app {

// Empty where there is no such text.
inline std::string text(const nlohmann::json& from, const char* field) {
    return from.contains(field) && from[field].is_string() ? from[field].get<std::string>()
                                                           : std::string();
}
inline bool is_set(const nlohmann::json& from, const char* field) {
    return from.contains(field) && from[field].is_boolean() && from[field].get<bool>();
}

// The reason why a lobby with "held_back" names nobody.
inline constexpr const char* held_back =
    "Somebody who came by this link was removed, so it does not show who is there.";

}  // namespace theatron::app
