// SPDX-License-Identifier: Apache-2.0
#include "room/mark_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "session/mark_testing.h"

namespace theatron::room {
namespace {

using session::between;
using session::examples;
using session::Mark;
using session::MarkKind;
using session::pin;

// The volume inside, by the divergence theorem, and whether each edge is used as often in either
// direction.
struct Shape {
    double volume_m3 = 0;
    bool closed = true;
};
Shape shape_of(const render::MeshData& mesh) {
    Shape shape;
    // Rings, caps and seams have vertices of their own at equal places, up to rounding.
    std::map<std::array<long, 3>, std::uint32_t> places;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    const auto at = [](float m) { return std::lround(double(m) * 1e6); };
    const auto place = [&](std::uint32_t i) {
        const auto& v = mesh.vertices[i];
        return places.try_emplace({at(v.px), at(v.py), at(v.pz)}, std::uint32_t(places.size()))
            .first->second;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vec3 p[3];
        std::uint32_t corner[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& v = mesh.vertices[mesh.indices[i + k]];
            p[k] = {double(v.px), double(v.py), double(v.pz)};
            corner[k] = place(mesh.indices[i + k]);
        }
        shape.volume_m3 += dot(p[0], cross(p[1], p[2])) / 6;
        for (std::size_t k = 0; k < 3; ++k)
            if (corner[k] != corner[(k + 1) % 3]) {
                ++edges[{corner[k], corner[(k + 1) % 3]}];
                --edges[{corner[(k + 1) % 3], corner[k]}];
            }
    }
    for (const auto& [edge, balance] : edges)
        shape.closed = shape.closed && balance == 0;
    return shape;
}

TEST(MarkMesh, ATubeIsClosedAndAsThickAsItShouldBe) {
    const render::MeshData mesh = make_mark_mesh(between(MarkKind::stroke, {}, {0.1, 0, 0}));
    // On the surface, not in it.
    for (const auto& v : mesh.vertices)
        EXPECT_GT(v.py, -1e-6);
    const Shape shape = shape_of(mesh);
    EXPECT_TRUE(shape.closed);
    // An octagon's area is 2 sqrt(2) r squared.
    EXPECT_NEAR(shape.volume_m3, 0.1 * 2.8284 * 0.0016 * 0.0016, 1e-9);
}

TEST(MarkMesh, EveryKindHasAClosedMeshThatFacesOutwards) {
    for (const Mark& mark : examples()) {
        const Shape shape = shape_of(make_mark_mesh(mark));
        EXPECT_TRUE(shape.closed) << to_text(mark.kind);
        EXPECT_GT(shape.volume_m3, 0) << to_text(mark.kind);
    }
}

TEST(MarkMesh, PointsAtOnePlaceStillHaveAMesh) {
    for (const MarkKind kind : {MarkKind::stroke, MarkKind::arrow, MarkKind::distance})
        for (const auto& v : make_mark_mesh(between(kind, {1, 1, 1}, {1, 1, 1})).vertices)
            ASSERT_TRUE(std::isfinite(v.px + v.nx + v.py + v.ny + v.pz + v.nz));
}

TEST(MarkMesh, LabelsSayNumberLengthAndAuthor) {
    EXPECT_EQ(label_of(pin()), "12 AB");
    EXPECT_EQ(label_of(between(MarkKind::arrow, {}, {1, 0, 0})), "AB");
    Mark distance = between(MarkKind::distance, {}, {0.0123, 0, 0});
    EXPECT_EQ(label_of(distance), "12.3 mm AB");
    distance.deviation_m = 0.0015f;
    EXPECT_EQ(label_of(distance), "12.3 mm \u00b1 3.0 mm AB");
}

}  // namespace
}  // namespace theatron::room
