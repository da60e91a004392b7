// SPDX-License-Identifier: Apache-2.0
// The places of cameras in the room, in a file (docs/formats/places.md) or given by hand.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec.h"

namespace theatron::capture {

struct CameraPlaces {
    struct Entry {
        std::string camera;  // CameraInfo::name
        Pose room_from_camera;
        // Covariance of rotation (about the camera's axes, radians), then translation (along them,
        // metres), row by row; empty if unknown.
        std::optional<std::array<double, 36>> covariance;
        std::optional<double> depth_offset_mm;  // distance by which the camera measures too far
        std::optional<Vec3> color_gain;         // factors of red, green, blue sRGB values
        bool operator==(const Entry&) const = default;
    };

    std::string made;    // RFC 3339, UTC
    std::string method;  // for people
    std::vector<Entry> cameras;

    const Entry* find(std::string_view camera) const;
    // A number for Calibration::registration, made from the content.
    std::uint64_t registration() const;
    bool operator==(const CameraPlaces&) const = default;
};

// Parsed places, or the problem of the text, as the end of a sentence that begins with the file's
// name.
struct ParsedPlaces {
    CameraPlaces places;
    std::string problem;
};

// Safe for untrusted input.
ParsedPlaces parse_places(std::string_view json);
std::string write_places(const CameraPlaces& places);

// Reads the file; throws Error with one sentence.
CameraPlaces load_places(const std::string& path);

// Reads "X:Y:Z", "X:Y:Z:YAW", and so on to ROLL: metres, and degrees. With all angles 0 the camera
// is level and looks along -z; yaw turns it to the left, pitch upwards, roll clockwise. Nothing if
// the text is not of this form.
std::optional<Pose> parse_place(std::string_view text);

}  // namespace theatron::capture
