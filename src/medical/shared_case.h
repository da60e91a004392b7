// SPDX-License-Identifier: Apache-2.0
// The description of a case that a session shares (docs/formats/shared_case.md): what a participant
// needs to show it, and nothing that identifies a patient. It names each surface and series by the
// hash of its bytes; the hash of the description names the whole case.
//
// Pure functions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/content_hash.h"
#include "base/status.h"
#include "geometry/vec.h"
#include "medical/case.h"

namespace theatron::medical {

inline constexpr std::size_t max_shared_parts = 256;
inline constexpr std::size_t max_shared_series = 16;
inline constexpr std::size_t max_shared_pictures = 64;
inline constexpr std::size_t max_shared_text = 2000;  // bytes of one text

struct SharedContent {
    ContentHash hash;
    std::uint64_t size = 0;  // bytes, at least 1
    bool operator==(const SharedContent&) const = default;
};

struct SharedPart {
    std::string name;
    Role role = Role::other;
    Rgb color;
    std::uint8_t opacity = 255;
    SharedContent mesh;  // docs/formats/case_mesh.md
    bool operator==(const SharedPart&) const = default;
};

struct SharedSeries {
    std::string name, modality;
    SharedContent volume;              // docs/formats/case_volume.md
    std::uint16_t missing_slices = 0;  // how many
    bool operator==(const SharedSeries&) const = default;
};

struct SharedPicture {
    std::string name;
    SharedContent picture;  // docs/formats/case_picture.md
    bool operator==(const SharedPicture&) const = default;
};

struct SharedCase {
    std::string name;
    bool deidentified = false;
    std::string license, credit;
    // The middle of all parts, or of the first series; patient coordinates (LPS). It is 0 where
    // there are pictures alone.
    Vec3 middle_mm;
    std::vector<SharedPart> parts;
    std::vector<SharedSeries> series;
    std::vector<SharedPicture> pictures;
    bool operator==(const SharedCase&) const = default;

    std::uint64_t content_bytes() const;
};

Bytes encode_shared_case(const SharedCase& shared);

// Safe for any bytes. Texts are clean (base/outside_text.h). Sizes are those that the description
// claims: check them before memory is taken.
Result<SharedCase> decode_shared_case(ByteView bytes);

}  // namespace theatron::medical
