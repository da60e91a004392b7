// SPDX-License-Identifier: Apache-2.0
// How a camera sees a flat rectangle: a projective map (homography) from the rectangle to a
// picture.
#pragma once

#include <array>

namespace theatron::photon {

struct Point {
    double x = 0, y = 0;
};

inline Point operator+(Point a, Point b) {
    return {a.x + b.x, a.y + b.y};
}
inline Point operator-(Point a, Point b) {
    return {a.x - b.x, a.y - b.y};
}
inline Point operator*(Point a, double factor) {
    return {a.x * factor, a.y * factor};
}
inline double cross(Point a, Point b) {
    return a.x * b.y - a.y * b.x;
}
double length(Point a);

// Corners in a picture, clockwise as seen with y down, no three of them on a line.
using Quad = std::array<Point, 4>;

inline Point middle_of(const Quad& quad) {
    return (quad[0] + quad[1] + quad[2] + quad[3]) * 0.25;
}

// False for corners that are not finite, not convex and clockwise, or nearly on a line.
bool is_proper(const Quad& quad);

class PlaneMap {
public:
    // Maps the rectangle from `first` (left and top) to `last` (right and bottom) to a proper quad
    // whose corners are those at the rectangle's left top, right top, right bottom, left bottom.
    PlaneMap(const Quad& corners, Point first, Point last);

    Point to_picture(Point place) const;
    // Not finite for points that no place of the plane is seen at.
    Point to_plane(Point pixel) const;

private:
    std::array<double, 9> forward_{}, backward_{};  // row by row
};

}  // namespace theatron::photon
