// SPDX-License-Identifier: Apache-2.0
#include "medical/isosurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "medical/mesh_measures.h"
#include "medical/mesh_shaping.h"

namespace theatron::medical {
namespace {

VolumeGrid cube_grid(int side, double step_mm) {
    const double low = -(side - 1) * step_mm / 2;
    return {side, side, side, {low, low, low}, {step_mm, 0, 0}, {0, step_mm, 0}, {0, 0, step_mm}};
}

FieldLayer layers(const VolumeGrid& grid, std::function<double(Vec3)> distance) {
    return [grid, distance](int slice, std::span<float> out) {
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column)
                out[std::size_t(row * grid.columns + column)] =
                    float(distance(grid.point_at(column, row, slice)));
    };
}

Mesh ball(double radius, int side = 40) {
    const VolumeGrid grid = cube_grid(side, 2.5 * radius / side);
    return isosurface(grid, layers(grid, [=](Vec3 p) { return length(p) - radius; }));
}

TEST(Isosurface, ABallIsAClosedSurfaceOfItsVolume) {
    const MeshShape shape = shape_of(ball(20));
    EXPECT_TRUE(shape.manifold);
    EXPECT_NEAR(shape.volume_mm3, 4.0 / 3 * std::numbers::pi * 8000, 100);
}

TEST(Isosurface, AMirroredGridGivesASurfaceThatTurnsOutwards) {
    VolumeGrid grid = cube_grid(20, 2);
    grid.column_step_mm = -grid.column_step_mm;
    grid.origin_mm.x = -grid.origin_mm.x;
    const Mesh mesh = isosurface(grid, layers(grid, [](Vec3 p) { return length(p) - 15; }));
    EXPECT_GT(shape_of(mesh).volume_mm3, 0);
}

TEST(Isosurface, NoiseGivesManifoldSurfaces) {
    // Samples of exactly 0, and inside at the border, too.
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 rng(seed);
        const VolumeGrid grid = cube_grid(9, 1);
        const Mesh mesh = isosurface(grid, [&](int, std::span<float> out) {
            for (float& value : out)
                value = float(int(rng() % 3) - 1);
        });
        ASSERT_FALSE(mesh.triangles.empty());
        EXPECT_TRUE(shape_of(mesh).manifold) << seed;
    }
}

TEST(Isosurface, StopsAtTheBudget) {
    const VolumeGrid grid = cube_grid(40, 1);
    const auto field = layers(grid, [](Vec3 p) { return length(p) - 15; });
    EXPECT_TRUE(isosurface(grid, field, 100).triangles.empty());
}

TEST(MeshShaping, WeldingJoinsTheCornersOfAnStlFile) {
    const Mesh closed = ball(10, 12);
    Mesh loose;
    for (const Triangle& t : closed.triangles) {
        const auto first = std::uint32_t(loose.positions.size());
        for (const std::uint32_t v : t)
            loose.positions.push_back(closed.positions[v]);
        loose.triangles.push_back({first, first + 1, first + 2});
    }
    loose.triangles.push_back({0, 0, 1});
    EXPECT_FALSE(shape_of(loose).closed);
    weld(loose);
    EXPECT_TRUE(shape_of(loose).manifold);
    EXPECT_EQ(loose.positions.size(), closed.positions.size());
}

TEST(MeshShaping, SimplifyingKeepsSurfacesManifoldAndNear) {
    Mesh mesh = ball(20);
    const double volume = shape_of(mesh).volume_mm3;
    simplify(mesh, 500);
    EXPECT_LE(mesh.triangles.size(), 500u);
    EXPECT_GT(mesh.triangles.size(), 480u);
    EXPECT_TRUE(shape_of(mesh).manifold);
    EXPECT_NEAR(shape_of(mesh).volume_mm3, volume, 0.03 * volume);
    for (const Vec3f p : mesh.positions)
        EXPECT_NEAR(length(to_double(p)), 20, 0.4);
}

TEST(MeshShaping, SimplifyingNoiseAsFarAsItGoesKeepsItManifold) {
    std::mt19937 rng(3);
    const VolumeGrid grid = cube_grid(12, 1);
    Mesh mesh = isosurface(grid, [&](int, std::span<float> out) {
        for (float& value : out)
            value = float(int(rng() % 7) - 2) + 0.5f;
    });
    simplify(mesh, 0);
    ASSERT_FALSE(mesh.triangles.empty());
    EXPECT_TRUE(shape_of(mesh).manifold);
}

TEST(MeshShaping, OpenEdgesStay) {
    // A square of 10 x 10 cells, and nothing to keep inside it.
    Mesh mesh;
    for (int y = 0; y <= 10; ++y)
        for (int x = 0; x <= 10; ++x)
            mesh.positions.push_back({float(x), float(y), 0});
    for (std::uint32_t y = 0; y < 10; ++y)
        for (std::uint32_t x = 0; x < 10; ++x) {
            const std::uint32_t i = y * 11 + x;
            mesh.triangles.push_back({i, i + 1, i + 12});
            mesh.triangles.push_back({i, i + 12, i + 11});
        }
    simplify(mesh, 2);
    EXPECT_LT(mesh.triangles.size(), 100u);
    EXPECT_NEAR(shape_of(mesh).area_mm2, 100, 1e-3);
}

TEST(MeshShaping, SmoothingTakesStepsAwayAndTheVolumeComesBack) {
    // Inside or outside and nothing between: a staircase.
    const VolumeGrid grid = cube_grid(40, 1);
    Mesh mesh = isosurface(grid, layers(grid, [](Vec3 p) { return length(p) < 15 ? -1.0 : 1.0; }));
    const double volume = 4.0 / 3 * std::numbers::pi * 15 * 15 * 15;
    const double steps = shape_of(mesh).area_mm2;
    smooth(mesh, 40);
    restore_volume(mesh, volume);
    const MeshShape shape = shape_of(mesh);
    EXPECT_TRUE(shape.manifold);
    EXPECT_NEAR(shape.volume_mm3, volume, 0.005 * volume);
    EXPECT_LT(shape.area_mm2, steps);
    EXPECT_NEAR(shape.area_mm2, 4 * std::numbers::pi * 225, 0.05 * 4 * std::numbers::pi * 225);
    for (const Vec3f p : mesh.positions)
        EXPECT_NEAR(length(to_double(p)), 15, 0.6);
}

}  // namespace
}  // namespace theatron::medical
