// SPDX-License-Identifier: Apache-2.0
#include "study/bricks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>

namespace theatron::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A red 2x4 with a blue 1x2 on its corner, half of which hangs over.
Construction small() {
    return {{{BrickColor::red, 4, 2, 0, 0, 0}, {BrickColor::blue, 2, 1, 3, 0, 1}}};
}

bool touch(const Brick& a, const Brick& b) {
    return (a.layer == b.layer + 1 || b.layer == a.layer + 1) && a.x < b.x + b.width &&
           b.x < a.x + a.width && a.y < b.y + b.depth && b.y < a.y + a.depth;
}

TEST(Bricks, CountsOfASmallConstruction) {
    EXPECT_EQ(count_bricks(small(), BrickColor::red), 1);
    EXPECT_EQ(count_bricks(small(), BrickColor::green), 0);
    EXPECT_EQ(free_studs(small(), BrickColor::red), 7);
    EXPECT_EQ(free_studs(small(), BrickColor::blue), 2);
}

TEST(Bricks, ASetNeedsOneOfEachKindHoweverTurned) {
    const Brick red{BrickColor::red, 2, 4}, blue{BrickColor::blue, 1, 2};
    EXPECT_TRUE(can_be_built(small(), {red, blue}));
    EXPECT_TRUE(can_be_built(small(), {blue, red, blue}));
    EXPECT_FALSE(can_be_built(small(), {red, red}));
    EXPECT_FALSE(can_be_built(small(), {red, {BrickColor::blue, 2, 2}}));
}

TEST(Bricks, ConstructionsHoldTogetherAndNothingIsTwiceAtAPlace) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const int count = 2 + int(seed % 39);
        const Construction made = make_construction(seed, count);
        ASSERT_EQ(int(made.bricks.size()), count);
        std::set<std::vector<int>> cells;
        std::size_t studs = 0;
        for (const Brick& b : made.bricks)
            for (int i = 0; i < b.width * b.depth; ++i, ++studs)
                cells.insert({b.x + i % b.width, b.y + i / b.width, b.layer});
        EXPECT_EQ(cells.size(), studs) << seed;
        EXPECT_EQ(made.bricks.front().layer, 0);
        // From the first brick all others are reached.
        std::set<std::size_t> reached{0};
        for (bool grows = true; grows;) {
            grows = false;
            for (std::size_t i = 0; i < made.bricks.size(); ++i)
                if (!reached.contains(i) &&
                    std::any_of(reached.begin(), reached.end(),
                                [&](auto j) { return touch(made.bricks[i], made.bricks[j]); }))
                    grows = reached.insert(i).second;
        }
        EXPECT_EQ(reached.size(), made.bricks.size()) << seed;
    }
}

TEST(Bricks, QuestionsHaveTheAnswersOfTheirConstruction) {
    std::map<int, int> buildable;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Construction made = make_construction(seed, 9);
        const auto questions = make_questions(made, seed, 12);
        ASSERT_EQ(questions.size(), 12u);
        std::set<std::string> texts;
        for (const BrickQuestion& question : questions) {
            EXPECT_TRUE(texts.insert(question.text).second);
            if (question.kind == BrickQuestion::Kind::buildable) {
                ++buildable[question.answer];
                continue;
            }
            for (int c = 0; c < brick_colors; ++c)
                if (question.text.find(std::string(name_of(BrickColor(c))) + " ") !=
                    std::string::npos)
                    EXPECT_EQ(question.answer, question.kind == BrickQuestion::Kind::bricks
                                                   ? count_bricks(made, BrickColor(c))
                                                   : free_studs(made, BrickColor(c)));
        }
    }
    EXPECT_GT(buildable[0], 80);
    EXPECT_GT(buildable[1], 80);
}

TEST(Bricks, ASeedGivesTheSameConstruction) {
    EXPECT_EQ(make_construction(5, 9), make_construction(5, 9));
    EXPECT_NE(make_construction(5, 9), make_construction(6, 9));
}

TEST(Bricks, ThePlanHasEachBrickOnceAndIsTrueToScale) {
    const std::string plan = construction_plan(small(), "Task <1>");
    EXPECT_THAT(plan, HasSubstr("Task &lt;1&gt;"));
    EXPECT_THAT(plan, HasSubstr("1 x red 2x4"));
    EXPECT_THAT(plan, HasSubstr("width='32.00' height='16.00' fill='#c4281b'"));
    EXPECT_THAT(plan, HasSubstr("a stud is 8 mm"));
    std::size_t circles = 0;
    for (std::size_t at = 0; (at = plan.find("<circle", at)) != std::string::npos; ++at)
        ++circles;
    EXPECT_EQ(circles, 10u);
}

// Each edge of the surface belongs to two triangles, once in each direction.
TEST(Bricks, TheMeshIsClosedAndHasTheVolumeOfItsBricks) {
    std::istringstream obj(construction_obj(small(), BrickColor::red));
    std::vector<std::array<double, 3>> corners;
    std::map<std::pair<int, int>, int> edges;
    double volume = 0;
    for (std::string line; std::getline(obj, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            auto& p = corners.emplace_back();
            words >> p[0] >> p[1] >> p[2];
        } else if (kind == "f") {
            int f[3];
            words >> f[0] >> f[1] >> f[2];
            for (int i = 0; i < 3; ++i)
                ++edges[{f[i], f[(i + 1) % 3]}];
            const auto &a = corners.at(std::size_t(f[0] - 1)),
                       &b = corners.at(std::size_t(f[1] - 1)),
                       &c = corners.at(std::size_t(f[2] - 1));
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                       a[2] * (b[0] * c[1] - b[1] * c[0])) /
                      6;
        }
    }
    ASSERT_FALSE(edges.empty());
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ((edges[{edge.second, edge.first}]), 1);
    }
    // The box, and 8 studs with an octagon as their base.
    const double octagon = 2 * std::sqrt(2.0) * 2.4 * 2.4;
    EXPECT_NEAR(volume, 31.8 * 15.8 * 9.6 + 8 * octagon * 1.7, 15);
    EXPECT_EQ(construction_obj(small(), BrickColor::green), "");
}

TEST(Bricks, TheMeshIsThePlanAndNotItsMirrorImage) {
    // Seen from above, x to the right: what is further down on the plan has a smaller y.
    const Construction two{{{BrickColor::red, 2, 2, 0, 0, 0}, {BrickColor::blue, 2, 2, 0, 3, 0}}};
    const auto first_y = [&](BrickColor color) {
        const std::string obj = construction_obj(two, color);
        double x = 0, y = 0;
        EXPECT_EQ(std::sscanf(obj.c_str() + obj.find("\nv "), "\nv %lf %lf", &x, &y), 2);
        return y;
    };
    EXPECT_GT(first_y(BrickColor::red), first_y(BrickColor::blue));
}

TEST(Bricks, ABrickThatHangsIsMarked) {
    const Construction bridge{{{BrickColor::red, 2, 2, 0, 0, 0},
                               {BrickColor::white, 6, 2, 0, 0, 1},
                               {BrickColor::blue, 2, 2, 4, 0, 0}}};
    EXPECT_THAT(construction_plan(bridge, "t"), Not(HasSubstr("^")));
    const Construction hanging{{{BrickColor::red, 2, 2, 0, 0, 1},
                                {BrickColor::white, 6, 2, 0, 0, 2},
                                {BrickColor::blue, 2, 2, 0, 0, 0},
                                {BrickColor::green, 2, 2, 4, 0, 1}}};
    EXPECT_THAT(construction_plan(hanging, "t"), HasSubstr("G^"));
    EXPECT_THAT(construction_plan(hanging, "t"), HasSubstr("^ has no brick below it"));
    EXPECT_THAT(construction_plan(hanging, "t"), Not(HasSubstr("R^")));
    EXPECT_THAT(construction_text(hanging), HasSubstr("2 deep, hangs from layer 3"));
}

}  // namespace
}  // namespace theatron::study
