// SPDX-License-Identifier: Apache-2.0
#include "photon/plane_map.h"

#include <cmath>
#include <cstddef>

namespace theatron::photon {
namespace {

using Matrix = std::array<double, 9>;

Point apply(const Matrix& m, Point p) {
    const double w = m[6] * p.x + m[7] * p.y + m[8];
    return {(m[0] * p.x + m[1] * p.y + m[2]) / w, (m[3] * p.x + m[4] * p.y + m[5]) / w};
}

// The adjugate, which is the inverse but for a factor.
Matrix adjugate(const Matrix& m) {
    return {m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
            m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
            m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
}

// From the unit square; Heckbert, "Fundamentals of Texture Mapping and Image Warping"
// (1989), 2.2.3.
Matrix from_unit_square(const Quad& q) {
    const Point a = q[1] - q[2], b = q[3] - q[2], sum = q[0] - q[1] + q[2] - q[3];
    const double area = cross(a, b);
    const double g = cross(sum, b) / area, h = cross(a, sum) / area;
    return {q[1].x - q[0].x + g * q[1].x,
            q[3].x - q[0].x + h * q[3].x,
            q[0].x,
            q[1].y - q[0].y + g * q[1].y,
            q[3].y - q[0].y + h * q[3].y,
            q[0].y,
            g,
            h,
            1};
}

}  // namespace

double length(Point a) {
    return std::hypot(a.x, a.y);
}

bool is_proper(const Quad& quad) {
    constexpr double least_sine = 0.05, farthest = 1e6;
    for (std::size_t i = 0; i < 4; ++i) {
        const Point side = quad[(i + 1) % 4] - quad[i],
                    next = quad[(i + 2) % 4] - quad[(i + 1) % 4];
        if (!(std::abs(quad[i].x) < farthest && std::abs(quad[i].y) < farthest) ||
            !(cross(side, next) > least_sine * length(side) * length(next)))
            return false;
    }
    return true;
}

PlaneMap::PlaneMap(const Quad& corners, Point first, Point last) {
    const Matrix unit = from_unit_square(corners);
    const double sx = 1 / (last.x - first.x), sy = 1 / (last.y - first.y);
    for (std::size_t row = 0; row < 9; row += 3) {
        forward_[row] = unit[row] * sx;
        forward_[row + 1] = unit[row + 1] * sy;
        forward_[row + 2] = unit[row + 2] - unit[row] * sx * first.x - unit[row + 1] * sy * first.y;
    }
    backward_ = adjugate(forward_);
}

Point PlaneMap::to_picture(Point place) const {
    return apply(forward_, place);
}

Point PlaneMap::to_plane(Point pixel) const {
    return apply(backward_, pixel);
}

}  // namespace theatron::photon
