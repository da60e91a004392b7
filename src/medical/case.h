// SPDX-License-Identifier: Apache-2.0
// A case: the patient's organs and images that a session shows, as its manifest describes them
// (docs/formats/case.md). Nothing here identifies a person.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/view.h"

namespace theatron::medical {

// The kind of a part. It decides the part's default colour and opacity and the drawing order.
enum class Role : std::uint8_t { shell, artery, portal_vein, hepatic_vein, tumour, other };

inline constexpr std::array<std::string_view, 6> role_names{"shell",        "artery", "portal_vein",
                                                            "hepatic_vein", "tumour", "other"};

inline std::string_view to_text(Role role) {
    return role_names[std::size_t(role)];
}
std::optional<Role> role_from_text(std::string_view text);

// The role that a name such as "Liver capsule" or "aorta_left" suggests; other if none.
Role role_of_name(std::string_view name);

Rgb usual_color(Role role);
double usual_opacity(Role role);

// Unit and axes of positions. A finished case has millimetres and LPS.
enum class Unit : std::uint8_t { mm, cm, m };
enum class Axes : std::uint8_t {
    lps,   // DICOM: x to the left, y to the back, z to the head
    ras,   // NIfTI: x to the right, y to the front, z to the head
    y_up,  // glTF: x to the left, y to the head, z to the front
};

struct Part {
    std::string name;
    Role role = Role::other;
    std::string file;  // a plain name in the case's folder
    Rgb color;
    double opacity = 1;  // 0 to 1
    bool operator==(const Part&) const = default;
};

struct Series {
    std::string name;
    std::string modality;  // as DICOM names it: "CT", "MR"
    std::string file;
    std::vector<int> missing_slices;  // filled with the lowest sample; numbered from 0
    bool operator==(const Series&) const = default;
};

// A picture without a place in the patient: a photograph, a sheet, a screenshot.
struct CasePicture {
    std::string name;
    std::string file;
    bool operator==(const CasePicture&) const = default;
};

struct Case {
    std::string name;
    Unit unit = Unit::mm;
    Axes axes = Axes::lps;
    bool deidentified = false;
    std::string license, credit;
    std::vector<Part> parts;
    std::vector<Series> series;
    std::vector<CasePicture> pictures;
    bool operator==(const Case&) const = default;
};

}  // namespace theatron::medical
