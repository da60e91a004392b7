// SPDX-License-Identifier: Apache-2.0
#include "render/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace theatron::render {
namespace {

std::vector<TriangleTree::Triangle> random_triangles(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1, 1), size(-0.2, 0.2);
    std::vector<TriangleTree::Triangle> all;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a{place(random), place(random), place(random)};
        all.push_back({a, a + Vec3{size(random), size(random), size(random)},
                       a + Vec3{size(random), size(random), size(random)}});
    }
    return all;
}

TEST(TriangleTree, FindsWhatTestingEveryTriangleFinds) {
    for (const std::size_t count : {1u, 2u, 5u, 37u, 400u}) {
        const auto triangles = random_triangles(count, unsigned(count));
        const TriangleTree tree(triangles);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> place(-2, 2);
        int hits = 0;
        for (int ray = 0; ray < 300; ++ray) {
            const Vec3 from{place(random), place(random), place(random)};
            Vec3 direction{place(random), place(random), place(random)};
            if (ray % 5 == 0)
                direction = {0, 0, 1};
            std::optional<double> nearest;
            for (const auto& triangle : triangles)
                if (const auto hit = TriangleTree(std::vector{triangle}).nearest(from, direction))
                    nearest = std::min(nearest.value_or(hit->distance), hit->distance);
            const auto found = tree.nearest(from, direction);
            ASSERT_EQ(found.has_value(), nearest.has_value());
            if (found) {
                EXPECT_EQ(found->distance, *nearest);
                ++hits;
            }
        }
        EXPECT_TRUE(count < 400 || hits > 10) << hits;
    }
}

TEST(TriangleTree, TheNormalPointsToWhereTheCornersRunCounterClockwise) {
    const TriangleTree tree(std::vector<TriangleTree::Triangle>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    for (const double side : {1.0, -1.0}) {
        const auto hit = tree.nearest({0.2, 0.2, 2 * side}, {0, 0, -side});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, 2, 1e-12);
        EXPECT_NEAR(hit->normal.z, 1, 1e-12);
    }
    EXPECT_FALSE(tree.nearest({0.2, 0.2, 2}, {0, 0, 1})) << "it lies behind";
    EXPECT_FALSE(tree.nearest({0.8, 0.8, 2}, {0, 0, -1})) << "beside it";
    EXPECT_FALSE(TriangleTree(std::vector<TriangleTree::Triangle>{}).nearest({0, 0, 0}, {0, 0, 1}));
}

}  // namespace
}  // namespace theatron::render
