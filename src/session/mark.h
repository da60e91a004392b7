// SPDX-License-Identifier: Apache-2.0
// Marks: what people draw onto surfaces to show one another what they mean.
//
// A mark is an object of the room of kind mark; its pose is that of the frame of its points, which
// is the frame of the surface that it sticks to. Pure data and functions. Lengths are metres.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/ids.h"
#include "geometry/vec.h"

namespace theatron::session {

enum class MarkKind : std::uint8_t { stroke = 1, arrow, pin, distance };
enum class MarkedSurface : std::uint8_t { cloud = 1, organ, slice };

std::string_view to_text(MarkKind kind);
std::string_view to_text(MarkedSurface surface);

struct MarkPoint {
    Vec3 position;
    Vec3 normal;  // of the surface, of length 1
    bool operator==(const MarkPoint&) const = default;
};

struct Mark {
    MarkKind kind = MarkKind::stroke;
    MarkedSurface surface = MarkedSurface::cloud;
    std::uint32_t object = 0;  // the organ or screen that it sticks to; 0 for the live cloud
    std::uint8_t color = 0;    // drawn as room::color_of(ParticipantId{color})
    std::string initials;      // of the author
    std::uint16_t number = 0;  // of a pin, from 1; else 0
    // For a distance the standard deviation of its length; 0: unknown. Else 0.
    float deviation_m = 0;
    // A stroke has 2 or more; an arrow tail and tip; a pin 1; a distance both ends.
    std::vector<MarkPoint> points;
    bool operator==(const Mark&) const = default;
};

inline constexpr std::size_t most_mark_points = 200;
inline constexpr std::size_t most_initials_bytes = 12;
inline constexpr std::uint32_t mark_colors = 7;
inline constexpr double farthest_mark_point_m = 1000;  // along each axis

// The properties of an object of kind mark (docs/formats/mark.md), at most 4 KiB. encode_mark()
// rounds positions to float, and normals to 1 / 32767. decode_mark() is safe for untrusted input:
// nullopt for bytes that are no mark.
Bytes encode_mark(const Mark& mark);
std::optional<Mark> decode_mark(ByteView properties);

// Mark::color of an author.
constexpr std::uint8_t color_number(ParticipantId author) {
    return std::uint8_t(std::uint32_t(author) % mark_colors);
}

// The first letters of the first and the last word of a name without its titles ("Dr.", "Prof."),
// in UTF-8; "?" without any.
std::string initials_of(std::string_view name);
// True also for those in which a title counts as a word, as in programs of version 0.1.0.
bool may_be_initials_of(std::string_view name, std::string_view initials);

// A line with fewer points, at most `most` (2 or more). The ends stay, and the point that is
// farthest from the line so far is kept next, until no point that was left out is farther than
// `tolerance_m` (Douglas and Peucker 1973) or there are `most` points.
std::vector<MarkPoint> simplified(const std::vector<MarkPoint>& line, double tolerance_m,
                                  std::size_t most);

}  // namespace theatron::session
