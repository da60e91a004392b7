// SPDX-License-Identifier: Apache-2.0
#include "registration/plane_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace theatron::registration {
namespace {

constexpr int seed_size = 6;     // pixels; the flat piece that a search starts from
constexpr int seed_step = 6;     // pixels from one start to the next
constexpr int most_missing = 4;  // pixels of a start without a measurement
constexpr double first_radius_m = 0.12;
constexpr double least_share_measured = 0.7;  // of the first piece
// Surfaces seen at a flatter angle are left out: cosine between ray and normal.
constexpr double least_cosine = 0.3;

// Sums for the least squares of 1/z over (x, y, 1).
struct Sums {
    double xx = 0, xy = 0, x = 0, yy = 0, y = 0, n = 0, wx = 0, wy = 0, w = 0, ww = 0;

    void add(Ray ray, double inverse) {
        xx += double(ray.x) * ray.x;
        xy += double(ray.x) * ray.y;
        x += ray.x;
        yy += double(ray.y) * ray.y;
        y += ray.y;
        n += 1;
        wx += inverse * ray.x;
        wy += inverse * ray.y;
        w += inverse;
        ww += inverse * inverse;
    }

    std::optional<Plane> solve() const {
        // Cramer's rule about the mean direction: the matrix is small and well scaled there.
        if (n < 3)
            return {};
        const double mx = x / n, my = y / n, mw = w / n;
        const double cxx = xx - x * mx, cxy = xy - x * my, cyy = yy - y * my;
        const double cwx = wx - w * mx, cwy = wy - w * my;
        const double determinant = cxx * cyy - cxy * cxy;
        if (!(determinant > 1e-9 * cxx * cyy))
            return {};
        const double qx = (cwx * cyy - cwy * cxy) / determinant;
        const double qy = (cwy * cxx - cwx * cxy) / determinant;
        return Plane{{qx, qy, mw - qx * mx - qy * my}};
    }

    // Mean squared residual of 1/z.
    double mean_square(const Plane& p) const {
        const double fitted = p.q.x * wx + p.q.y * wy + p.q.z * w;
        return std::max(0.0, (ww - fitted) / n);
    }
};

// Half a pixel's extent as a difference of directions, from the middle of the image.
struct Pitch {
    double x, y;
};

Pitch pitch_of(const SparseDepth& depth) {
    const auto rays = depth.rays->view();
    const int y = depth.size.height / 2, x = depth.size.width / 2;
    return {std::abs(double(rays.row(y)[x].x) - rays.row(y)[x - 1].x),
            std::abs(double(rays.row(y)[x].y) - rays.row(y - 1)[x].y)};
}

class Search {
public:
    Search(const SparseDepth& depth, const SurfaceSize& wanted,
           std::vector<std::uint8_t>& explained)
        : depth_(depth), wanted_(wanted), explained_(explained), pitch_(pitch_of(depth)) {
        explained_.assign(depth.size.area(), 0);
    }

    std::vector<FoundPlane> run() {
        std::vector<FoundPlane> found;
        for (int y = 0; y + seed_size <= depth_.size.height; y += seed_step)
            for (int x = 0; x + seed_size <= depth_.size.width; x += seed_step)
                if (const auto plane = try_seed(x, y))
                    found.push_back(*plane);
        return found;
    }

private:
    Ray ray(int x, int y) const { return depth_.rays->view().row(y)[x]; }
    float inverse(int x, int y) const {
        return depth_.inverse_m[std::size_t(y) * std::size_t(depth_.size.width) + std::size_t(x)];
    }

    std::optional<FoundPlane> try_seed(int x0, int y0) {
        int missing = 0;
        for (int y = y0; y < y0 + seed_size; ++y)
            for (int x = x0; x < x0 + seed_size; ++x) {
                missing += inverse(x, y) == 0;
                if (missing > most_missing ||
                    explained_[std::size_t(y) * std::size_t(depth_.size.width) + std::size_t(x)])
                    return {};
            }
        Sums sums;
        for (int y = y0; y < y0 + seed_size; ++y)
            for (int x = x0; x < x0 + seed_size; ++x)
                if (inverse(x, y) != 0)
                    sums.add(ray(x, y), inverse(x, y));
        auto plane = sums.solve();
        if (!plane || !is_seen_well(*plane, ray(x0 + seed_size / 2, y0 + seed_size / 2)))
            return {};
        const double w = sums.w / sums.n;
        const double tolerance = plane_tolerance_m(1 / w) / 2 * w * w;
        if (sums.mean_square(*plane) > tolerance * tolerance)
            return {};

        const Vec3 seed = plane->point(ray(x0 + seed_size / 2, y0 + seed_size / 2));
        const auto first = gather(*plane, seed, first_radius_m, 2, false);
        if (first.area_m2 < least_share_measured * first_radius_m * first_radius_m * 2.2 ||
            !first.fitted)
            return {};
        auto more = gather(*first.fitted, seed, wanted_.radius_m * 0.45, 2, false);
        if (!more.fitted)
            return {};
        // All that lies on this plane is explained, and no search starts there again.
        const auto all = gather(*more.fitted, seed, wanted_.radius_m, 2, true);
        if (all.area_m2 < wanted_.least_area_m2 || all.area_m2 > wanted_.largest_area_m2 ||
            !all.fitted)
            return {};
        return FoundPlane{*all.fitted, all.middle, all.area_m2};
    }

    static bool is_seen_well(const Plane& plane, Ray ray) {
        const double inverse = plane.inverse_depth(ray);
        const Vec3 direction{ray.x, ray.y, 1};
        return inverse > 0.05 && inverse / (length(plane.q) * length(direction)) > least_cosine;
    }

    struct Gathered {
        std::optional<Plane> fitted;
        Vec3 middle;
        double area_m2 = 0;
    };

    // Points on `plane` within `radius_m` of `middle`, of every `step`-th row and column.
    Gathered gather(const Plane& plane, Vec3 middle, double radius_m, int step, bool mark) {
        const double reach_x = radius_m / middle.z / pitch_.x * 1.4;
        const double reach_y = radius_m / middle.z / pitch_.y * 1.4;
        // The pixel that sees `middle`, about: directions grow evenly enough for a window.
        const auto [mx, my] = pixel_near({float(middle.x / middle.z), float(middle.y / middle.z)});
        const int left = std::max(0, int(mx - reach_x)), top = std::max(0, int(my - reach_y));
        const int right = std::min(depth_.size.width, int(mx + reach_x) + 1);
        const int bottom = std::min(depth_.size.height, int(my + reach_y) + 1);

        Sums sums;
        Gathered result;
        const double length_q = length(plane.q), radius2 = radius_m * radius_m;
        const double near_tolerance = tolerance_m * length_q;
        const double far_tolerance = tolerance_per_m * length_q;
        double sum_x = 0, sum_y = 0, sum_z = 0;
        for (int y = top; y < bottom; y += step) {
            const Ray* rays = depth_.rays->view().row(y);
            const float* inverse =
                &depth_.inverse_m[std::size_t(y) * std::size_t(depth_.size.width)];
            for (int x = left; x < right; x += step) {
                const double w = inverse[x];
                if (w == 0)
                    continue;
                const double on_plane = plane.inverse_depth(rays[x]);
                // |on_plane - w| within plane_tolerance_m(1 / w) * w * length_q, times w.
                if (std::abs(on_plane - w) * w > (near_tolerance * w * w + far_tolerance) ||
                    on_plane <= 0)
                    continue;
                const double z = 1 / w;
                const double dx = rays[x].x * z - middle.x, dy = rays[x].y * z - middle.y,
                             dz = z - middle.z;
                if (dx * dx + dy * dy + dz * dz > radius2)
                    continue;
                sums.add(rays[x], w);
                sum_x += rays[x].x * z;
                sum_y += rays[x].y * z;
                sum_z += z;
                result.area_m2 += 1 / (on_plane * on_plane * on_plane);
                if (mark)
                    explained_[std::size_t(y) * std::size_t(depth_.size.width) + std::size_t(x)] =
                        1;
            }
        }
        result.area_m2 *= pitch_.x * pitch_.y * length_q * step * step;
        if (sums.n > 0)
            result.middle = Vec3{sum_x, sum_y, sum_z} * (1 / sums.n);
        if (sums.n >= 12)
            result.fitted = sums.solve();
        return result;
    }

    Vec2 pixel_near(Ray wanted) const {
        const Ray middle = ray(depth_.size.width / 2, depth_.size.height / 2);
        return {depth_.size.width / 2 + (wanted.x - middle.x) / pitch_.x,
                depth_.size.height / 2 + (wanted.y - middle.y) / pitch_.y};
    }

    const SparseDepth& depth_;
    const SurfaceSize& wanted_;
    std::vector<std::uint8_t>& explained_;
    Pitch pitch_;
};

}  // namespace

std::vector<FoundPlane> find_planes(const SparseDepth& depth, const SurfaceSize& wanted,
                                    std::vector<std::uint8_t>& explained) {
    return Search(depth, wanted, explained).run();
}

}  // namespace theatron::registration
