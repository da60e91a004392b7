// SPDX-License-Identifier: Apache-2.0
// Limits of the pictures that people show of themselves without a link for senders: the face
// (wire::CameraKind::face) and a browser's screen (wire::CameraKind::screen). Every participant may
// show them, so the host bounds what they cost the others.
//
// Pure; time is passed in.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/time.h"
#include "geometry/screen.h"
#include "session/request_budget.h"
#include "wire/control.h"

namespace theatron::session {

// A taller picture than a wide one has the same limit of pixels. Bytes of a message are those of
// one encoded picture with its header: a usual face has a third of them, a usual screen a quarter.
inline constexpr std::size_t max_face_pixels = 320 * 240, max_face_message = 48 * 1024;
inline constexpr std::size_t max_screen_pixels = 1920 * 1200, max_screen_message = 1024 * 1024;
inline constexpr double max_face_fps = 15, max_screen_fps = 15;
// A face's are its pictures' alone.
inline constexpr double max_face_bytes_per_s = 1e6, max_screen_bytes_per_s = 3e6;
// Faces in a session at once: the other places of wire::max_cameras are for cameras of the room.
inline constexpr std::size_t max_faces = 40;

struct OwnPictureLimits {
    wire::Feature feature;  // of the participants who may show it
    std::size_t max_pixels;
    double max_fps;
    std::size_t max_message;
    double max_bytes_per_s;  // on average, of one stream in one setting
    // Everybody gets it in these codecs, which every program has, also as an encoder, and every
    // browser. Letters of screens stay sharp at theirs.
    std::string_view depth_codec, color_codec;
    wire::TextCode forbidden, beyond_limits, one_each;  // why an offer is refused
};

inline constexpr OwnPictureLimits face_limits{wire::Feature::webcam,
                                              max_face_pixels,
                                              max_face_fps,
                                              max_face_message,
                                              max_face_bytes_per_s,
                                              "raw",
                                              "jpeg:quality=75",
                                              wire::TextCode::face_forbidden,
                                              wire::TextCode::face_beyond_limits,
                                              wire::TextCode::one_face};
inline constexpr OwnPictureLimits screen_limits{wire::Feature::shows_screen,
                                                max_screen_pixels,
                                                max_screen_fps,
                                                max_screen_message,
                                                max_screen_bytes_per_s,
                                                "raw",
                                                "jpeg:quality=85",
                                                wire::TextCode::screen_forbidden,
                                                wire::TextCode::screen_beyond_limits,
                                                wire::TextCode::one_screen};

// Null for the kinds of cameras that need a link for senders.
constexpr const OwnPictureLimits* own_picture_limits(wire::CameraKind offered_as) {
    switch (offered_as) {
        case wire::CameraKind::face:
            return &face_limits;
        case wire::CameraKind::screen:
            return &screen_limits;
        case wire::CameraKind::room:
        case wire::CameraKind::person:
            return nullptr;
    }
    return nullptr;
}

inline bool is_within(const OwnPictureLimits& limits, const Calibration& calibration,
                      double frames_per_second) {
    return is_screen(calibration) && calibration.color.size.area() <= limits.max_pixels &&
           frames_per_second > 0 && frames_per_second <= limits.max_fps;
}

// The pictures of one stream in one setting that are let through: a third more a second than
// max_fps, since cameras and networks are uneven, a few at once, and a second's worth of bytes.
class OwnPicturePace {
public:
    explicit OwnPicturePace(const OwnPictureLimits& limits)
        : most_(limits.max_message),
          pictures_(limits.max_fps * 4 / 3, 5),
          bytes_(limits.max_bytes_per_s, limits.max_bytes_per_s) {}

    bool take(TimePoint now, std::size_t bytes) {
        return bytes <= most_ && pictures_.take(now) && bytes_.take(now, double(bytes));
    }

private:
    std::size_t most_;
    TokenBucket pictures_, bytes_;
};

}  // namespace theatron::session
