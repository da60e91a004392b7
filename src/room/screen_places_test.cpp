// SPDX-License-Identifier: Apache-2.0
// The host knows nothing of furniture; the places that it gives to screens are free of it.
#include "session/screen_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "furniture/furnish.h"
#include "room/virtual_room.h"

namespace theatron::room {
namespace {

using furniture::Box;

// The box around the picture with its caption.
Box box_around(const ScreenPlace& screen) {
    const double x = screen.width_m / 2, y = screen.height_m / 2;
    Box box{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
    for (const Vec3 corner :
         {Vec3{-x, -y - screen.width_m / 15, 0}, Vec3{x, -y - screen.width_m / 15, 0},
          Vec3{-x, y, 0}, Vec3{x, y, 0}}) {
        const Vec3 p = screen.room_from_screen * corner;
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                    std::max(box.high.z, p.z)};
    }
    return box;
}

bool meet(const Box& a, const Box& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y &&
           a.low.z < b.high.z && b.low.z < a.high.z;
}

// A triangle of the piece reaches into the box.
bool meets(const furniture::Piece& piece, const Box& box) {
    for (const auto& part : piece.model.parts)
        for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
            Box triangle{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& v = part.mesh.vertices[part.mesh.indices[i + k]];
                const Vec3 p = piece.room_from_piece * Vec3{v.px, v.py, v.pz};
                triangle.low = {std::min(triangle.low.x, p.x), std::min(triangle.low.y, p.y),
                                std::min(triangle.low.z, p.z)};
                triangle.high = {std::max(triangle.high.x, p.x), std::max(triangle.high.y, p.y),
                                 std::max(triangle.high.z, p.z)};
            }
            if (meet(box, triangle))
                return true;
        }
    return false;
}

TEST(ScreenPlaces, FreeOnesTouchNoFurnitureAndNoWall) {
    const auto extent = extent_of({});
    ASSERT_TRUE(extent);
    const auto pieces = furniture::furnish(*extent, {});
    ASSERT_GT(pieces.size(), 15u);
    for (const double shape : {9 / 16.0, 3 / 4.0, 4 / 3.0})
        for (const double width_m : {0.4, 0.8, 1.2, 1.8}) {
            const double height_m = width_m * shape;
            std::vector<ScreenPlace> screens;
            while (const auto pose = session::free_screen_place(width_m, height_m, screens)) {
                screens.push_back({*pose, width_m, height_m});
                ASSERT_LT(screens.size(), 100u);
                const Box box = box_around(screens.back());
                EXPECT_GT(box.low.x, extent->left);
                EXPECT_LT(box.high.x, extent->right);
                EXPECT_GT(box.low.z, extent->back);
                EXPECT_LT(box.high.z, extent->front);
                EXPECT_GT(box.low.y, 0);
                EXPECT_LT(box.high.y, extent->height);
                for (const auto& piece : pieces)
                    EXPECT_FALSE(meets(piece, box)) << piece.name << ", screen " << screens.size()
                                                    << ", " << width_m << " x " << height_m;
            }
            if (height_m < 1)
                EXPECT_GE(screens.size(), 4u) << width_m;
        }
}

}  // namespace
}  // namespace theatron::room
