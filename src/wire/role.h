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
    relay = 4,      // no person: a program that sends pictures on (docs/decisions/relays.md)
};
// Those of people.
inline constexpr Role roles[] = {Role::operator_, Role::expert, Role::observer, Role::publisher};

constexpr bool is_known(Role role) {
    return role <= Role::relay;
}
constexpr bool is_of_person(Role role) {
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
        case Role::relay:
            return "relay";
    }
    return "unknown";
}

// The role of a person.
constexpr std::optional<Role> parse_role(std::string_view text) {
    for (const Role role : roles)
        if (text == text_of(role))
            return role;
    return std::nullopt;
}
// The role of a link, which may be for a relay.
constexpr std::optional<Role> parse_link_role(std::string_view text) {
    return text == text_of(Role::relay) ? std::optional(Role::relay) : parse_role(text);
}

}  // namespace theatron::wire
