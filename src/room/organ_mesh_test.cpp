// SPDX-License-Identifier: Apache-2.0
#include "room/organ_mesh.h"

#include <gtest/gtest.h>

namespace theatron::room {
namespace {

TEST(OrganMesh, TheHeadIsUpAndTheFrontTowardsZInMetres) {
    const Vec3 middle{10, 20, 30};
    const auto near = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-12; };
    EXPECT_TRUE(near(organ_from_patient({110, 20, 30}, middle), {0.1, 0, 0})) << "left";
    EXPECT_TRUE(near(organ_from_patient({10, 20, 130}, middle), {0, 0.1, 0})) << "head";
    EXPECT_TRUE(near(organ_from_patient({10, -80, 30}, middle), {0, 0, 0.1})) << "front";
    const Vec3 any{-31, 7, 250};
    EXPECT_LT(length(patient_from_organ(organ_from_patient(any, middle), middle) - any), 1e-9);
}

TEST(OrganMesh, TrianglesKeepTheirOuterSide) {
    medical::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {50, 0, 0}, {0, 50, 0}};
    mesh.triangles = {{0, 1, 2}};
    medical::compute_normals(mesh);
    const render::MeshData data = make_organ_mesh(mesh, {});
    ASSERT_EQ(data.vertices.size(), 3u);
    const auto at = [&](std::size_t i) {
        const auto& v = data.vertices[data.indices[i]];
        return Vec3{v.px, v.py, v.pz};
    };
    const Vec3 outwards = normalized(cross(at(1) - at(0), at(2) - at(0)));
    const auto& v = data.vertices[0];
    EXPECT_GT(dot(outwards, Vec3{v.nx, v.ny, v.nz}), 0.999);
}

}  // namespace
}  // namespace theatron::room
