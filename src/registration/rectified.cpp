// SPDX-License-Identifier: Apache-2.0
#include "registration/rectified.h"

#include <algorithm>
#include <cmath>

namespace theatron::registration {

PlaneAxes axes_on(const Plane& plane, Vec3 middle) {
    const Vec3 z = plane.normal();
    const Vec3 helper = std::abs(z.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = normalized(helper - z * dot(helper, z));
    // On the plane itself, where the mean of noisy points is not quite.
    const Vec3 origin = middle + z * ((1 - dot(plane.q, middle)) / -length(plane.q));
    return {origin, x, cross(z, x), z};
}

PlaneAxes turned(const PlaneAxes& a, double angle) {
    const Vec3 x = a.x * std::cos(angle) + a.y * std::sin(angle);
    return {a.origin, x, cross(a.z, x), a.z};
}

Rectified rectify(const DepthLookup& lookup, const PlaneAxes& axes, double reach_m, double cell_m) {
    Rectified picture;
    picture.side = 2 * int(std::ceil(reach_m / cell_m));
    picture.value.assign(std::size_t(picture.side) * std::size_t(picture.side), 0);
    const double first = (0.5 - picture.side / 2) * cell_m;
    const float metres = float(lookup.metres_per_unit);
    const int width = lookup.depth.size.width, height = lookup.depth.size.height;
    // z . p is the same all over the plane.
    const float to_plane = float(-dot(axes.z, axes.origin));
    const float step_x = float(axes.x.x * cell_m), step_y = float(axes.x.y * cell_m),
                step_z = float(axes.x.z * cell_m);
    for (int j = 0; j < picture.side; ++j) {
        const Vec3 p = axes.origin + axes.x * first + axes.y * (first + j * cell_m);
        const float x0 = float(p.x), y0 = float(p.y), z0 = float(p.z);
        std::int8_t* out = &picture.value[std::size_t(j) * std::size_t(picture.side)];
        for (int i = 0; i < picture.side; ++i) {
            const float z = z0 + step_z * float(i);
            if (z <= 0)
                continue;
            const float per_z = 1 / z;
            const PixelLookup::Pixel pixel = lookup.pixels->at((x0 + step_x * float(i)) * per_z,
                                                               (y0 + step_y * float(i)) * per_z);
            const float nearest_x = pixel.x + 0.5f, nearest_y = pixel.y + 0.5f;
            if (!(nearest_x >= 0 && nearest_y >= 0 && nearest_x < float(width) &&
                  nearest_y < float(height)))
                continue;
            const float measured = float(lookup.depth.row(int(nearest_y))[int(nearest_x)]) * metres;
            if (measured == 0)
                continue;
            const float behind = (measured - z) * to_plane * per_z;
            const float tolerance = float(plane_tolerance_m(double(z)));
            out[i] = std::abs(behind) <= tolerance ? 1 : behind > 2 * tolerance ? -1 : 0;
        }
    }
    return picture;
}

Rectified quarter_turned(const Rectified& picture) {
    Rectified result{picture.side, std::vector<std::int8_t>(picture.value.size())};
    const int side = picture.side;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            result.value[std::size_t(y) * std::size_t(side) + std::size_t(x)] =
                picture.row(x)[side - 1 - y];
    return result;
}

double edge_angle(const Rectified& picture, int arm) {
    const int side = picture.side;
    // The sum of the cells from `arm` below to `arm` above, and if some are +1 and some are -1.
    struct Column {
        std::int8_t sum, has_surface, has_gap;
    };
    std::vector<Column> columns(static_cast<std::size_t>(side));
    double cosine = 0, sine = 0;
    for (int y = arm; y + arm < side; ++y) {
        for (int x = 0; x < side; ++x) {
            int sum = 0, least = 0, largest = 0;
            for (int k = -arm; k <= arm; ++k) {
                const int v = picture.row(y + k)[x];
                sum += v;
                least = std::min(least, v);
                largest = std::max(largest, v);
            }
            columns[std::size_t(x)] = {std::int8_t(sum), std::int8_t(largest), std::int8_t(-least)};
        }
        const std::int8_t* above = picture.row(y + arm);
        const std::int8_t* below = picture.row(y - arm);
        for (int x = arm; x + arm < side; ++x) {
            const Column &left = columns[std::size_t(x - arm)],
                         &right = columns[std::size_t(x + arm)];
            int gy = 0, least = -std::max(left.has_gap, right.has_gap),
                largest = std::max(left.has_surface, right.has_surface);
            for (int k = -arm; k <= arm; ++k) {
                const int a = above[x + k], b = below[x + k];
                gy += a - b;
                least = std::min({least, a, b});
                largest = std::max({largest, a, b});
            }
            // Beside pixels that were never measured there is no edge of the board.
            if (least == 0 || largest == 0)
                continue;
            const int gx = right.sum - left.sum;
            const double squares = gx * gx + gy * gy;
            if (squares == 0)
                continue;
            // Four times the angle is the same for all four directions of a rectangle's edges: the
            // fourth power of gx + i gy, its length that of the square.
            const double re = double(gx * gx - gy * gy), im = 2.0 * gx * gy;
            cosine += (re * re - im * im) / squares;
            sine += 2 * re * im / squares;
        }
    }
    return std::atan2(sine, cosine) / 4;
}

}  // namespace theatron::registration
