// SPDX-License-Identifier: Apache-2.0
// Limits of the picture of a participant's face (wire::CameraKind::face): it is small, so that
// every participant can send one. The host checks them.
//
// Pure; time is passed in.
#pragma once

#include <cstddef>
#include <string_view>

#include "geometry/screen.h"
#include "session/request_budget.h"

namespace theatron::session {

// A taller picture than a wide one has the same limit of pixels.
inline constexpr std::size_t max_face_pixels = 320 * 240;
inline constexpr double max_face_fps = 15;
// Bytes of one encoded picture with its header; a usual one has a third of them.
inline constexpr std::size_t max_face_message = 48 * 1024;
// Faces in a session at once: the other places of wire::max_cameras are for cameras of the room.
inline constexpr std::size_t max_faces = 40;

// Everybody gets faces in these codecs, which every program has, also as an encoder.
inline constexpr std::string_view face_depth_codec = "raw", face_color_codec = "jpeg:quality=75";

inline bool is_face(const Calibration& calibration, double frames_per_second) {
    return is_screen(calibration) && calibration.color.size.area() <= max_face_pixels &&
           frames_per_second > 0 && frames_per_second <= max_face_fps;
}

// The pictures of one stream in one setting that are let through: a third more a second than
// max_face_fps, since cameras and networks are uneven, and a few at once.
struct FacePace : TokenBucket {
    FacePace() : TokenBucket(max_face_fps * 4 / 3, 5) {}
};

}  // namespace theatron::session
