// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "furniture/baked_light.h"
#include "furniture/furnish.h"
#include "furniture/pieces.h"
#include "furniture/shell.h"

namespace theatron::furniture {
namespace {

using render::MeshData;

const Extent usual{-3.5, 3.5, -3.5, 3.5, 3};

std::vector<Piece> usual_pieces() {
    return furnish(usual, {});
}

const Piece* find(const std::vector<Piece>& pieces, std::string_view name) {
    for (const Piece& piece : pieces)
        if (piece.name == name)
            return &piece;
    return nullptr;
}

Vec3 place_of(const MeshData::Vertex& v) {
    return {v.px, v.py, v.pz};
}

using Place = std::tuple<long, long, long>;
Place rounded(Vec3 p) {
    return {std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6)};
}

TEST(Furniture, IsClosedAndItsNormalsPointOutside) {
    for (const Piece& piece : usual_pieces())
        for (const Model::Part& part : piece.model.parts) {
            const MeshData& mesh = part.mesh;
            // On a closed surface each edge has as many triangles on one side as on the other.
            std::map<std::pair<Place, Place>, int> edges;
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                Vec3 p[3], normals;
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto& v = mesh.vertices[mesh.indices[i + k]];
                    p[k] = place_of(v);
                    normals = normals + Vec3{v.nx, v.ny, v.nz};
                }
                const Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
                ASSERT_GT(length(n), 1e-10) << piece.name << " has a triangle without area";
                ASSERT_GT(dot(n, normals), 0) << piece.name;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Place a = rounded(p[k]), b = rounded(p[(k + 1) % 3]);
                    ++edges[{a, b}];
                    --edges[{b, a}];
                }
            }
            for (const auto& [edge, count] : edges)
                ASSERT_EQ(count, 0) << piece.name << " has a hole";
            for (const auto& v : mesh.vertices)
                ASSERT_NEAR(length(Vec3{v.nx, v.ny, v.nz}), 1, 1e-3) << piece.name;
        }
}

TEST(Furniture, HasManyPiecesAndFewTriangles) {
    const std::vector<Piece> pieces = usual_pieces();
    std::set<std::string_view> names;
    std::size_t triangles = 0;
    for (const Piece& piece : pieces) {
        names.insert(piece.name);
        for (const Model::Part& part : piece.model.parts)
            triangles += part.mesh.indices.size() / 3;
    }
    EXPECT_EQ(names.size(), pieces.size()) << "no two pieces have one name";
    EXPECT_GE(pieces.size(), 30u);
    EXPECT_LT(triangles, 30000u);
}

TEST(Furniture, StandsOnTheFloorHangsOnAWallOrUnderTheCeiling) {
    constexpr double touch_m = 0.012;
    for (const Piece& piece : usual_pieces()) {
        const Box& b = piece.box;
        const bool carried = b.low.y < touch_m || b.high.y > usual.height - touch_m ||
                             b.low.x < usual.left + touch_m || b.high.x > usual.right - touch_m ||
                             b.low.z < usual.back + touch_m || b.high.z > usual.front - touch_m;
        EXPECT_TRUE(carried) << piece.name;
        EXPECT_GT(b.low.y, -1e-6) << piece.name << " is in the floor";
        EXPECT_LT(b.high.y, usual.height + 1e-6) << piece.name << " is in the ceiling";
    }
}

TEST(Furniture, HasItsUsualSizes) {
    const std::vector<Piece> pieces = usual_pieces();
    const auto size = [&](std::string_view name) {
        const Piece* piece = find(pieces, name);
        return piece ? piece->box.high - piece->box.low : Vec3{};
    };
    // The table's top is below its sheet.
    const Box table = bounds(operating_table());
    EXPECT_NEAR(table.high.x - table.low.x, table_length_m, 0.02);
    EXPECT_NEAR((table.high.x + table.low.x) / 2, 0, 0.02);
    EXPECT_GE(table_top_m, 0.8);
    EXPECT_LE(table_top_m, 1.0);
    EXPECT_NEAR(size("double door").y, 2.29, 0.02);
    for (const Vec3 lamp : lamp_places) {
        EXPECT_GE(lamp.y, 2.0);
        EXPECT_LE(lamp.y, 2.2);
    }
    EXPECT_NEAR(size("anaesthesia machine").y, 1.8, 0.15);
    EXPECT_NEAR(size("stool").y, 0.57, 0.05);
}

TEST(Furniture, LeavesTheFloorFreeWherePeopleBeginToMeet) {
    for (const Piece& piece : usual_pieces()) {
        if (!piece.blocks)
            continue;
        for (const Box& box : obstacles_of(piece))
            for (int i = 0; i < 360; ++i) {
                const double a = radians_of(i), x = 1.5 * std::sin(a), z = 1.5 * std::cos(a);
                const bool inside = x > box.low.x - 0.2 && x < box.high.x + 0.2 &&
                                    z > box.low.z - 0.2 && z < box.high.z + 0.2;
                ASSERT_FALSE(inside) << piece.name << " at " << i << " degrees";
            }
    }
}

Calibration camera_at(Vec3 eye, Vec3 at) {
    Calibration camera;
    camera.depth = pinhole({640, 576}, 75);
    camera.registered = true;
    camera.room_from_camera = look_at(eye, at, {0, 1, 0});
    return camera;
}

TEST(Furniture, GivesWayWhereACameraSees) {
    const Calibration camera = camera_at({0, 2.2, 2}, {0, 0.9, 0});
    const std::vector<Piece> all = usual_pieces(), rest = furnish(usual, {camera});
    EXPECT_FALSE(find(rest, "operating table"));
    EXPECT_TRUE(find(rest, "double door")) << "it is behind the camera";
    EXPECT_LT(rest.size(), all.size());
    for (const Piece& piece : rest) {
        EXPECT_FALSE(is_seen(piece.box, camera)) << piece.name;
        const Piece* before = find(all, piece.name);
        ASSERT_TRUE(before) << piece.name << " appears because others gave way";
        EXPECT_EQ(before->room_from_piece, piece.room_from_piece);
    }
    Calibration unknown = camera;
    unknown.registered = false;
    EXPECT_EQ(furnish(usual, {unknown}).size(), all.size());
}

TEST(Furniture, IsSeenAheadAndNear) {
    const Box box{{-0.2, 0, -0.2}, {0.2, 1, 0.2}};
    EXPECT_TRUE(is_seen(box, camera_at({0, 1.5, 2}, {0, 1, 0})));
    EXPECT_FALSE(is_seen(box, camera_at({0, 1.5, 2}, {0, 1.5, 4}))) << "behind the camera";
    EXPECT_FALSE(is_seen(box, camera_at({0, 1.5, 6}, {0, 1, 0}))) << "too far to be measured";
    EXPECT_FALSE(is_seen(box, camera_at({0, 1.5, 2}, {3, 1.5, 1}))) << "beside the picture";
}

TEST(Furniture, StaysInsideOfAnyRoomAndDoesNotOverlap) {
    for (const Extent e :
         {Extent{-1.5, 6, -2, 5, 3}, Extent{4, 12, 3, 11, 4}, Extent{-10, 10, -8, 8, 3.5}}) {
        const std::vector<Piece> pieces = furnish(e, {});
        EXPECT_GE(pieces.size(), 8u);
        for (const Piece& piece : pieces) {
            EXPECT_GE(piece.box.low.x, e.left - 0.011) << piece.name;
            EXPECT_LE(piece.box.high.x, e.right + 0.011) << piece.name;
            EXPECT_GE(piece.box.low.z, e.back - 0.011) << piece.name;
            EXPECT_LE(piece.box.high.z, e.front + 0.011) << piece.name;
        }
    }
    EXPECT_FALSE(find(furnish({4, 12, 3, 11, 4}, {}), "operating table"))
        << "the origin is outside of that room";
}

TEST(BakedLight, IsBrightUnderTheLampsAndDarkUnderTheTable) {
    const std::vector<Piece> pieces = usual_pieces();
    const BakedLight light(usual, pieces);
    const double on_table = light.at({0, table_top_m + 0.03, 0}, {0, 1, 0});
    const double open_floor = light.at({1.0, 0, 1.5}, {0, 1, 0});
    const double below = light.at({0.75, 0.001, 0.05}, {0, 1, 0});
    EXPECT_GT(on_table, 1.5 * open_floor);
    EXPECT_LT(below, 0.7 * open_floor);
    const BakedLight empty(usual, {});
    EXPECT_GT(empty.at({0.75, 0, 0.05}, {0, 1, 0}), 1.3 * below);
    const double beside_wall = light.at({3.45, 1.5, 3.0}, {0, 0, -1});
    EXPECT_LT(beside_wall, light.at({2.0, 1.5, 3.0}, {0, 0, -1}));
}

TEST(BakedLight, IsShownAsTheScenesShadersShowIt) {
    const Rgb dark = shown({0, 0, 0}), middle = shown({0.18, 0.18, 0.18}),
              bright = shown({9, 9, 9});
    EXPECT_EQ(dark, (Rgb{0, 0, 0}));
    EXPECT_EQ(bright, (Rgb{255, 255, 255}));
    // 0.18 (1 + 0.03) / 1.18 = 0.157 is 0.433 in sRGB.
    EXPECT_NEAR(middle.g, 110, 1.5);
}

TEST(Shell, IsClosedAndSeenFromInside) {
    for (const Side side : all_sides) {
        const MeshData mesh = side_mesh(usual, side);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const Vec3 a = place_of(mesh.vertices[mesh.indices[i]]),
                       b = place_of(mesh.vertices[mesh.indices[i + 1]]),
                       c = place_of(mesh.vertices[mesh.indices[i + 2]]);
            EXPECT_GT(dot(cross(b - a, c - a), Vec3{0, 1.5, 0} - a), 0);
        }
        for (const auto& v : mesh.vertices) {
            EXPECT_GE(v.u, 0);
            EXPECT_LE(v.u, 1);
            EXPECT_GE(v.v, 0);
            EXPECT_LE(v.v, 1);
        }
    }
}

}  // namespace
}  // namespace theatron::furniture
