// SPDX-License-Identifier: Apache-2.0
// The roles of participants in a session. session/permissions.h says what each may do.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace theatron::wire {

// Numbers on the wire and in files; never reused.
enum class Role : std::uint8_t {
    expert = 0,     // speaks, points and handles objects
    publisher = 1,  // an expert whose cameras the others see
    observer = 2,   // sees
    operator_ = 3,  // of the operating room; decides on the others
};
inline constexpr Role roles[] = {Role::operator_, Role::expert, Role::observer, Role::publisher};

constexpr bool is_known(Role role) {
    return role <= Role::operator_;
}

// The one spelling of a role, in links, commands, files and figures.
constexpr const char* text_of(Role role) {
    switch (role) {
        case Role::expert:
            return "expert";
        case Role::publisher:
            return "publisher";
        case Role::observer:
            return "observer";
        case Role::operator_:
            return "operator";
    }
    return "unknown";
}

constexpr std::optional<Role> parse_role(std::string_view text) {
    for (const Role role : roles)
        if (text == text_of(role))
            return role;
    return std::nullopt;
}

}  // namespace theatron::wire
