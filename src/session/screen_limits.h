// SPDX-License-Identifier: Apache-2.0
// Limits of a screen that a browser shows (wire::CameraKind::screen): every expert may show one, so
// the host bounds what it costs the others.
//
// Pure; time is passed in.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/time.h"
#include "geometry/screen.h"
#include "session/request_budget.h"

namespace theatron::session {

inline constexpr std::size_t max_screen_pixels = 1920 * 1200;
inline constexpr double max_screen_fps = 15;
// Bytes of one encoded picture with its header; a usual one has a quarter of them.
inline constexpr std::size_t max_screen_message = 1024 * 1024;
inline constexpr double max_screen_bytes_per_s = 3e6;

// Everybody gets such screens in these codecs, which every browser encodes. Letters stay sharp at
// this quality.
inline constexpr std::string_view screen_depth_codec = "raw",
                                  screen_color_codec = "jpeg:quality=85";

inline bool is_shown_screen(const Calibration& calibration, double frames_per_second) {
    return is_screen(calibration) && calibration.color.size.area() <= max_screen_pixels &&
           frames_per_second > 0 && frames_per_second <= max_screen_fps;
}

// The pictures of one stream in one setting that are let through: a third more a second than
// max_screen_fps, and no more bytes than max_screen_bytes_per_s on average. A second's worth may
// come at once.
class ScreenPace {
public:
    bool take(TimePoint now, std::size_t bytes) {
        return bytes <= max_screen_message && pictures_.take(now) &&
               bytes_.take(now, double(bytes));
    }

private:
    TokenBucket pictures_{max_screen_fps * 4 / 3, 5};
    TokenBucket bytes_{max_screen_bytes_per_s, max_screen_bytes_per_s};
};

}  // namespace theatron::session
