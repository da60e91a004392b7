// SPDX-License-Identifier: Apache-2.0
#include "medical/mesh.h"

#include <gtest/gtest.h>

#include "medical/mesh_measures.h"

namespace theatron::medical {
namespace {

// The corner of a cube that is 6 mm long: 36 mm3.
Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    compute_normals(mesh);
    return mesh;
}

TEST(Mesh, BytesAreAsSpecified) {
    const Bytes bytes = encode_mesh(tetrahedron());
    ASSERT_EQ(bytes.size(), 16u + 4 * 24 + 4 * 12);
    const auto at = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), 4), "THME");
    EXPECT_EQ(at(4), 1);
    EXPECT_EQ(at(8), 4);
    EXPECT_EQ(at(12), 4);
    EXPECT_EQ(at(16 + 12 + 3), 0x40);  // 6 as a float: 40 c0 00 00
    EXPECT_EQ(at(16 + 12 + 2), 0xc0);
    EXPECT_EQ(at(16 + 96 + 4), 2);  // the second vertex of the first triangle
}

TEST(Mesh, ComesBackAsItWasWritten) {
    const Result<Mesh> read = decode_mesh(encode_mesh(tetrahedron()));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, tetrahedron());
}

TEST(Mesh, EveryTruncationIsRefused) {
    const Bytes whole = encode_mesh(tetrahedron());
    for (std::size_t n = 0; n < whole.size(); ++n)
        EXPECT_EQ(decode_mesh(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(n))).error(),
                  Status::truncated)
            << n;
}

TEST(Mesh, WhatCannotBeIsRefused) {
    const auto changed = [](auto change) {
        Bytes bytes = encode_mesh(tetrahedron());
        change(bytes);
        return decode_mesh(bytes).error();
    };
    EXPECT_EQ(changed([](Bytes& b) { b.push_back(std::byte(0)); }), Status::trailing_bytes);
    EXPECT_EQ(changed([](Bytes& b) { b[3] = std::byte('X'); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { b[4] = std::byte(2); }), Status::unsupported_version);
    EXPECT_EQ(changed([](Bytes& b) { b[7] = std::byte(1); }), Status::malformed);
    EXPECT_EQ(changed([](Bytes& b) { store_le(&b[8], 0xffffffffu); }), Status::too_large);
    EXPECT_EQ(changed([](Bytes& b) { store_le(&b[112], 4u); }), Status::malformed);  // no vertex 4
    EXPECT_EQ(changed([](Bytes& b) { store_le(&b[16], 0x7fc00000u); }), Status::malformed);  // NaN
    EXPECT_EQ(changed([](Bytes& b) { std::fill_n(&b[64], 12, std::byte(0)); }),
              Status::malformed);  // a normal of length 0
}

TEST(MeshShape, AClosedSurfaceHasItsVolume) {
    const MeshShape shape = shape_of(tetrahedron());
    EXPECT_TRUE(shape.closed);
    EXPECT_TRUE(shape.manifold);
    EXPECT_NEAR(shape.volume_mm3, 36, 1e-9);
    EXPECT_NEAR(shape.area_mm2, 3 * 18 + 31.1769, 1e-3);
}

TEST(MeshShape, AHoleATurnedTriangleAndAPinchAreSeen) {
    Mesh hole = tetrahedron();
    hole.triangles.pop_back();
    EXPECT_FALSE(shape_of(hole).closed);

    Mesh turned = tetrahedron();
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_FALSE(shape_of(turned).closed);

    // Two tetrahedra that share one vertex are closed, but two fans of triangles meet there.
    Mesh pinched = tetrahedron();
    for (const Vec3f p : {Vec3f{-6, 0, 0}, Vec3f{0, -6, 0}, Vec3f{0, 0, -6}})
        pinched.positions.push_back(p);
    for (const Triangle t : {Triangle{0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}})
        pinched.triangles.push_back(t);
    EXPECT_TRUE(shape_of(pinched).closed);
    EXPECT_FALSE(shape_of(pinched).manifold);
}

}  // namespace
}  // namespace theatron::medical
