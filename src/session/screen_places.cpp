// SPDX-License-Identifier: Apache-2.0
#include "session/screen_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace theatron::session {
namespace {

// Around the picture: rim, caption above it, and the air between two screens.
constexpr double rim_m = 0.03, caption_in_width = 2 / 30.0, air_m = 0.05, half_depth_m = 0.04;

// An upright box: `along` is a horizontal unit vector (x, z of the room).
struct Upright {
    Vec2 middle, along;
    double half_along = 0, half_across = 0;
    double low = 0, high = 0;
};

constexpr Upright box(double left, double right, double back, double front, double low,
                      double high) {
    return {{(left + right) / 2, (back + front) / 2},
            {1, 0},
            (right - left) / 2,
            (front - back) / 2,
            low,
            high};
}

// The furniture that reaches up to screens. The boxes of the supply unit and of the hanging monitor
// go on to the corners of the room, so that neither hides a screen from the table.
constexpr Upright furniture_boxes[] = {
    box(-0.80, 0.80, -0.72, 0.72, 1.90, 3.00),    // table lamps
    box(-1.10, -0.64, -2.20, -1.85, 0.00, 2.05),  // infusion stand
    box(-2.79, -1.75, 0.34, 1.51, 0.00, 1.81),    // anaesthesia machine
    box(-3.50, -1.55, -3.50, -0.90, 0.00, 3.00),  // supply unit
    box(1.42, 3.50, -3.50, -1.18, 0.00, 3.00),    // hanging monitor
    box(0.19, 0.89, 1.92, 2.57, 0.00, 1.24),      // electrosurgery cart
    box(-3.42, -2.78, 2.08, 2.67, 0.00, 1.46),    // ultrasound cart
    box(-3.37, -2.43, 2.91, 3.45, 0.00, 1.42),    // linen trolley
};
// A room has at least these walls, and its ceiling is at least so high.
constexpr double wall_m = 3.3, ceiling_m = 2.95, lowest_m = 0.9;

double dot(Vec2 a, Vec2 b) {
    return a.x * b.x + a.y * b.y;
}

Vec2 across(Vec2 along) {
    return {-along.y, along.x};
}

Upright box_of(const ScreenPlace& screen) {
    const Pose& pose = screen.room_from_screen;
    const double x = screen.width_m / 2 + rim_m, y = screen.height_m / 2 + rim_m;
    const Vec3 right = rotate(pose.rotation, {1, 0, 0});
    const double flat = std::hypot(right.x, right.z);
    Upright upright;
    upright.along = flat > 1e-6 ? Vec2{right.x / flat, right.z / flat} : Vec2{1, 0};
    upright.middle = {pose.translation.x, pose.translation.z};
    upright.low = upright.high = pose.translation.y;
    for (const Vec3 corner :
         {Vec3{-x, -y - caption_in_width * screen.width_m, 0},
          Vec3{x, -y - caption_in_width * screen.width_m, 0}, Vec3{-x, y, 0}, Vec3{x, y, 0}}) {
        const Vec3 place = pose * corner;
        const Vec2 from_middle{place.x - upright.middle.x, place.z - upright.middle.y};
        upright.low = std::min(upright.low, place.y);
        upright.high = std::max(upright.high, place.y);
        upright.half_along =
            std::max(upright.half_along, std::abs(dot(from_middle, upright.along)));
        upright.half_across =
            std::max(upright.half_across, std::abs(dot(from_middle, across(upright.along))));
    }
    upright.half_across += half_depth_m;
    return upright;
}

double reach(const Upright& box, Vec2 axis) {
    return box.half_along * std::abs(dot(box.along, axis)) +
           box.half_across * std::abs(dot(across(box.along), axis));
}

// Boxes that only touch do not overlap.
bool overlap(const Upright& a, const Upright& b) {
    if (a.high <= b.low || b.high <= a.low)
        return false;
    const Vec2 apart{b.middle.x - a.middle.x, b.middle.y - a.middle.y};
    for (const Vec2 axis : {a.along, across(a.along), b.along, across(b.along)})
        if (std::abs(dot(apart, axis)) >= reach(a, axis) + reach(b, axis))
            return false;
    return true;
}

bool is_clear(const Upright& screen) {
    if (screen.low < lowest_m || screen.high > ceiling_m ||
        std::abs(screen.middle.x) + reach(screen, {1, 0}) > wall_m ||
        std::abs(screen.middle.y) + reach(screen, {0, 1}) > wall_m)
        return false;
    return std::none_of(std::begin(furniture_boxes), std::end(furniture_boxes),
                        [&](const Upright& piece) { return overlap(screen, piece); });
}

// A side of the table: the distance of its screens from the table's middle, and the direction from
// which one sees them, about the vertical.
struct Side {
    double distance_m, turn_deg;
};
constexpr Side sides[] = {{1.8, 0}, {2.4, -90}, {2.75, 90}, {2.4, 180}};
constexpr double step_m = 0.1, farthest_along_m = 2.5;
constexpr double usual_height_m = 1.9;
static_assert(usual_screen_place.translation.y == usual_height_m);

Pose place_at(const Side& side, double along, double height) {
    const Pose turned{rotation_about({0, 1, 0}, side.turn_deg * std::numbers::pi / 180), {}};
    return turned * Pose{usual_screen_place.rotation, {along, height, -side.distance_m}};
}

}  // namespace

bool overlap(const ScreenPlace& a, const ScreenPlace& b) {
    return overlap(box_of(a), box_of(b));
}

bool is_clear_of_furniture(const ScreenPlace& screen) {
    return is_clear(box_of(screen));
}

std::optional<Pose> free_screen_place(double width_m, double height_m,
                                      const std::vector<ScreenPlace>& others) {
    std::vector<Upright> taken;
    for (const ScreenPlace& other : others) {
        taken.push_back(box_of(other));
        taken.back().half_along += air_m;
        taken.back().low -= air_m;
        taken.back().high += air_m;
    }
    const auto is_free = [&](const Pose& pose) {
        const Upright screen = box_of({pose, width_m, height_m});
        return is_clear(screen) &&
               std::none_of(taken.begin(), taken.end(),
                            [&](const Upright& other) { return overlap(screen, other); });
    };
    // High screens hang lower, so that they end below the ceiling.
    const double height = std::min(
        usual_height_m, ceiling_m - height_m / 2 - rim_m - caption_in_width * width_m - 0.01);
    for (const Side& side : sides)
        for (int step = 0; step * step_m < farthest_along_m; ++step)
            for (const double sign : {1.0, -1.0})
                if (const Pose pose = place_at(side, sign * step * step_m, height); is_free(pose))
                    return pose;
    return std::nullopt;
}

}  // namespace theatron::session
