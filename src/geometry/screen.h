// SPDX-License-Identifier: Apache-2.0
// Shared pictures in the room: a screen is a camera that looks at a flat surface
// (docs/decisions/screens.md).
//
// The depth image of a screen is the constant plane of the screen in screen_grid pixels; no sensor
// has so few. So a screen is announced, sent, recorded and replayed as a camera is.
#pragma once

#include "geometry/calibration.h"

namespace theatron {

inline constexpr Size screen_grid{16, 16};
// The camera stands so close before the screen that its place is the screen's.
inline constexpr int screen_distance_mm = 10;

// Where the first screen without a place stands: above the middle of the table's far side, facing
// the people on this one.
inline constexpr Pose usual_screen_place{Quat{0, 1, 0, 0}, Vec3{0, 1.9, -1.8}};
inline constexpr double usual_screen_width_m = 1.2, least_screen_width_m = 0.1,
                        largest_screen_width_m = 10;

inline bool is_screen(const Calibration& calibration) {
    return calibration.depth.size == screen_grid && calibration.color.size != Size{};
}

// The size in the room and the place of a screen. In its frame x points right, y down, z away from
// the reader; the origin is its middle.
struct ScreenPlace {
    Pose room_from_screen;
    double width_m = 0, height_m = 0;
    bool operator==(const ScreenPlace&) const = default;
};

// The calibration of a screen with this picture, `width_m` wide.
inline Calibration screen_calibration(Size picture, double width_m, const Pose& room_from_screen) {
    const double distance_m = screen_distance_mm / 1000.0;
    const double height_m = width_m * picture.height / picture.width;
    Calibration c;
    c.depth.size = screen_grid;
    // The outer pixels of the grid lie on the edges of the picture.
    c.depth.fx = (screen_grid.width - 1) * distance_m / width_m;
    c.depth.fy = (screen_grid.height - 1) * distance_m / height_m;
    c.depth.cx = (screen_grid.width - 1) / 2.0;
    c.depth.cy = (screen_grid.height - 1) / 2.0;
    c.color.size = picture;
    c.color.fx = c.color.fy = picture.width * distance_m / width_m;
    c.color.cx = (picture.width - 1) / 2.0;
    c.color.cy = (picture.height - 1) / 2.0;
    c.room_from_camera = room_from_screen * Pose{Quat{}, {0, 0, -distance_m}};
    c.registered = true;
    return c;
}

// Precondition: is_screen(calibration).
inline ScreenPlace screen_place(const Calibration& calibration) {
    const double distance_m = screen_distance_mm / 1000.0;
    return {calibration.room_from_camera * Pose{Quat{}, {0, 0, distance_m}},
            calibration.color.size.width * distance_m / calibration.color.fx,
            calibration.color.size.height * distance_m / calibration.color.fy};
}

}  // namespace theatron
