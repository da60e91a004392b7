// SPDX-License-Identifier: Apache-2.0
#include "synthetic/rasteriser.h"

#include <gtest/gtest.h>

#include <random>

#include "synthetic/operating_room.h"

namespace theatron::synthetic {
namespace {

// The depth of triangle (a, b, c) along `ray` in double precision; infinite if missed.
double cast(Vec3 a, Vec3 b, Vec3 c, Ray ray, double& nearest_edge) {
    const Vec3 d{ray.x, ray.y, 1};
    const Vec3 n = cross(b - a, c - a);
    const double across = dot(n, d);
    if (across >= 0)
        return INFINITY;
    const double z = dot(n, a) / across;
    const Vec3 p = d * z;
    nearest_edge = INFINITY;
    bool inside = z > 0.03;
    const Vec3 corners[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
        const Vec3 from = corners[i], to = corners[(i + 1) % 3];
        const double off = dot(cross(n, to - from), p - from) / (length(n) * length(to - from));
        nearest_edge = std::min(nearest_edge, std::abs(off));
        inside = inside && off >= 0;
    }
    return inside ? z : INFINITY;
}

// Small and large triangles, near the lens and partly behind it, under distortion: each pixel
// must have the depth of its own ray.
TEST(Rasteriser, EqualsRayCastingUnderDistortion) {
    CameraModel camera = scaled(synthetic_camera(Variant::room, 0, 2, {}).depth, {80, 72});
    const SampleGrid grid = make_grid(camera);
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<F3> points;
    std::vector<Triangle> triangles;
    for (int i = 0; i < 400; ++i) {
        const float size = i % 5 == 0 ? 2.0f : i % 5 == 1 ? 0.3f : 0.04f;
        const F3 at{2 * unit(rng), 2 * unit(rng), 1.5f + 1.6f * unit(rng)};
        for (int k = 0; k < 3; ++k)
            points.push_back(at + F3{unit(rng), unit(rng), unit(rng)} * size);
        triangles.push_back(
            {std::uint32_t(3 * i), std::uint32_t(3 * i + 1), std::uint32_t(3 * i + 2), {}});
    }
    Visibility seen;
    seen.clear(camera.size);
    rasterise(grid, points, triangles, 0, seen);
    int hits = 0;
    for (std::size_t i = 0; i < grid.rays.pixels.size(); ++i) {
        const Ray ray = grid.rays.pixels[i];
        if (ray.x == no_ray) {
            EXPECT_EQ(seen.depth.pixels[i], nothing_seen);
            continue;
        }
        double best = INFINITY, doubtful = INFINITY;
        for (const Triangle& t : triangles) {
            double edge = INFINITY;
            const double z =
                cast(to_vec3(points[t.a]), to_vec3(points[t.b]), to_vec3(points[t.c]), ray, edge);
            best = std::min(best, z);
            if (edge < 1e-5)
                doubtful = std::min(doubtful, edge);
        }
        if (doubtful < 1e-5)
            continue;  // on an edge: both triangles are correct
        if (best == INFINITY) {
            EXPECT_EQ(seen.depth.pixels[i], nothing_seen) << i;
        } else {
            ++hits;
            EXPECT_NEAR(seen.depth.pixels[i], best, 1e-5 * best) << i;
        }
    }
    EXPECT_GT(hits, 2000);
}

// Neighbouring triangles share their edges exactly, so a closed surface has no holes, for
// grids of any density and shift.
TEST(Rasteriser, AClosedSurfaceHasNoHoles) {
    const CameraModel camera =
        scaled(synthetic_camera(Variant::room, 1, 2, {1280, 720}).color, {64, 36});
    const Image<Ray> centres = make_ray_table(camera);
    const Mesh wall = make_sheet(170, 130,
                                 [](float u, float v) {
                                     return F3{8 * (0.5f - u), 8 * (v - 0.5f),
                                               2 + 0.3f * std::sin(20 * u) * std::sin(17 * v)};
                                 },
                                 {});
    for (const Vec2 shift : {Vec2{0, 0}, Vec2{0.33, -0.33}, Vec2{-0.33, 0.33}}) {
        const SampleGrid grid = make_fine_grid(camera, centres, 2, shift);
        Visibility seen;
        seen.clear(grid.rays.size);
        rasterise(grid, wall.positions, wall.triangles, 0, seen);
        int holes = 0;
        for (std::size_t i = 0; i < seen.depth.pixels.size(); ++i)
            holes += grid.rays.pixels[i].x != no_ray && seen.depth.pixels[i] == nothing_seen;
        EXPECT_EQ(holes, 0);
    }
}

}  // namespace
}  // namespace theatron::synthetic
