// SPDX-License-Identifier: Apache-2.0
// H.264 access units (ITU-T H.264, annex B) checked before any decoder sees them.
//
// A video decoder is a large program that was not written for hostile bytes. So
// only the few shapes that our encoder makes are let through to it: a key frame
// is one sequence header, one picture header and one IDR slice; any other frame
// is one slice. Pure functions, no allocation.
#pragma once

#include <optional>

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video::avc {

// Larger pictures are refused on both sides; level 5.1 has as many.
inline constexpr std::size_t max_area = 4096 * 2304;

enum class UnitType : std::uint8_t { slice = 1, idr_slice = 5, sequence = 7, picture = 8 };

// One unit of a stream.
struct Unit {
    ByteView with_start_code;
    ByteView content;  // from the header byte on
    UnitType type() const { return UnitType(std::to_integer<int>(content[0]) & 0x1f); }
};

// Takes the first unit off `stream`; nothing if it does not begin with one.
std::optional<Unit> take_unit(ByteView& stream);

// The fields of a sequence header that are needed here.
struct Sequence {
    Size size;
    int bits = 8;       // of a sample: 8 or 10
    bool grey = false;  // otherwise 4:2:0
    bool operator==(const Sequence&) const = default;
};

// Reads a sequence header (the content of its unit). Safe for untrusted input.
// Refuses (unsupported) what our encoder does not use and what would make a
// decoder hold more than one earlier frame or wait for later ones: interlace,
// several references, scaling lists, other samples than 4:2:0 or grey.
Result<Sequence> read_sequence(ByteView unit);

// The kind of an access unit, and its sequence header.
struct AccessUnit {
    bool key = false;
    Sequence sequence;  // of a key frame
};

// Reads an access unit of the shapes above, and nothing else. Safe for
// untrusted input.
Result<AccessUnit> read_access_unit(ByteView stream);

}  // namespace theatron::video::avc
