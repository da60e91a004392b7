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

TEST(ScreenPlaces, FreeOnesTouchNoFurnitureAndNoWall) {
    const auto extent = extent_of({});
    ASSERT_TRUE(extent);
    const auto pieces = furniture::furnish(*extent, {});
    ASSERT_GT(pieces.size(), 15u);
    for (const double width_m : {0.4, 0.8, 1.2, 1.8}) {
        std::vector<ScreenPlace> screens;
        while (const auto pose = session::free_screen_place(width_m, width_m * 9 / 16, screens)) {
            screens.push_back({*pose, width_m, width_m * 9 / 16});
            const Box box = box_around(screens.back());
            EXPECT_GT(box.low.x, extent->left);
            EXPECT_LT(box.high.x, extent->right);
            EXPECT_GT(box.low.z, extent->back);
            EXPECT_LT(box.high.z, extent->front);
            EXPECT_LT(box.high.y, extent->height);
            for (const auto& piece : pieces)
                for (const Box& part : furniture::obstacles_of(piece))
                    EXPECT_FALSE(meet(box, part))
                        << piece.name << ", screen " << screens.size() << ", " << width_m << " m";
            ASSERT_LT(screens.size(), 100u);
        }
        EXPECT_GE(screens.size(), 4u) << width_m;
    }
}

}  // namespace
}  // namespace theatron::room
