// SPDX-License-Identifier: Apache-2.0
#include "medical/case.h"

#include <algorithm>

namespace theatron::medical {
namespace {

// Lower-case letters and digits; everything else, and each change to upper case, parts words.
std::string words_of(std::string_view name) {
    std::string words = " ";
    bool was_lower = false;
    for (const char c : name) {
        const bool upper = c >= 'A' && c <= 'Z', lower = c >= 'a' && c <= 'z',
                   digit = c >= '0' && c <= '9';
        if (upper && was_lower)
            words += ' ';
        words += upper ? char(c - 'A' + 'a') : lower || digit ? c : ' ';
        was_lower = lower;
    }
    return words + " ";
}

struct Hint {
    std::string_view text;  // within words_of(); a blank means the edge of a word
    Role role;
};

// The first that fits decides, so the special ones come first.
constexpr Hint hints[] = {
    {"tumo", Role::tumour},
    {"lesion", Role::tumour},
    {" mass ", Role::tumour},
    {"metasta", Role::tumour},
    {" hcc ", Role::tumour},
    {"porta hepatis", Role::other},
    {"portal", Role::portal_vein},
    {"pfortader", Role::portal_vein},
    {"splenic vein", Role::portal_vein},
    {"mesenteric vein", Role::portal_vein},
    {" pv ", Role::portal_vein},
    {"hepatic vein", Role::hepatic_vein},
    {"lebervene", Role::hepatic_vein},
    {"vena cava", Role::hepatic_vein},
    {" ivc ", Role::hepatic_vein},
    {" hv ", Role::hepatic_vein},
    {"arter", Role::artery},
    {"aorta", Role::artery},
    {"celiac", Role::artery},
    {" ha ", Role::artery},
    {"capsule", Role::shell},
    {"shell", Role::shell},
    // Parts of the liver that are not the whole.
    {"impression", Role::other},
    {"ligament", Role::other},
    {"surface", Role::other},
    {"segment", Role::other},
    {" lobe ", Role::other},
    {" area ", Role::other},
    {" liver ", Role::shell},
    {" leber ", Role::shell},
    {"parenchyma", Role::shell},
};

}  // namespace

std::optional<Role> role_from_text(std::string_view text) {
    const auto found = std::find(role_names.begin(), role_names.end(), text);
    if (found == role_names.end())
        return std::nullopt;
    return Role(found - role_names.begin());
}

Role role_of_name(std::string_view name) {
    const std::string words = words_of(name);
    for (const Hint& hint : hints)
        if (words.find(hint.text) != std::string::npos)
            return hint.role;
    return Role::other;
}

Rgb usual_color(Role role) {
    switch (role) {
        case Role::shell:
            return {178, 92, 74};
        case Role::artery:
            return {214, 40, 40};
        case Role::portal_vein:
            return {70, 110, 210};
        case Role::hepatic_vein:
            return {110, 60, 160};
        case Role::tumour:
            return {236, 204, 60};
        case Role::other:
            break;
    }
    return {200, 190, 175};
}

double usual_opacity(Role role) {
    return role == Role::shell ? 0.35 : 1;
}

}  // namespace theatron::medical
