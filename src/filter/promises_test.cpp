// SPDX-License-Identifier: Apache-2.0
// Guarantees of the filters on scenes, tested on chains as cameras use them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "filter/chain.h"
#include "filter/test_depth.h"

namespace theatron::filter {
namespace {

constexpr Duration frame_time = std::chrono::microseconds(33'333);
constexpr Size size{64, 32};

// A wall with depth and noise set by the test, frame by frame, filtered by `kalman`.
class Wall {
public:
    explicit Wall(const char* filters = "kalman")
        : chain_(parse_chain(filters).settings, {.size = size}) {}

    const DepthImage& next(double mm, double sigma, Duration since = frame_time) {
        std::normal_distribution<double> noise;
        for (auto& pixel : in.pixels)
            pixel =
                mm > 0 ? std::uint16_t(std::lround(noise(random_) * sigma + mm)) : std::uint16_t(0);
        out = copy_of(chain_.apply(in.view(), since));
        return out;
    }
    double mean() const {
        double sum = 0;
        for (const auto pixel : out.pixels)
            sum += pixel;
        return sum / double(out.pixels.size());
    }
    DepthImage in{size}, out{size};

private:
    Chain chain_;
    std::mt19937 random_{3};
};

TEST(Kalman, AStillWallStandsStill) {
    Wall wall;
    double changed = 0, error = 0;
    DepthImage before;
    for (int i = 0; i < 80; ++i) {
        wall.next(2000.3, 1.5);
        if (i >= 40) {
            for (std::size_t p = 0; p < size.area(); ++p) {
                changed += wall.out.pixels[p] != before.pixels[p];
                error += std::abs(wall.out.pixels[p] - 2000.3);
            }
        }
        before = wall.out;
    }
    EXPECT_LT(changed / (40.0 * double(size.area())), 0.06) << "share of pixels that change";
    EXPECT_LT(error / (40.0 * double(size.area())), 0.6) << "mm";
}

TEST(Kalman, ARealStepIsThereAtOnce) {
    Wall wall;
    for (int i = 0; i < 40; ++i)
        wall.next(2000, 1);
    wall.next(1900, 1);
    EXPECT_NEAR(wall.mean(), 1900, 0.5);
    for (const auto pixel : wall.out.pixels)
        ASSERT_LT(pixel, 1910) << "a trail of what was there";
}

TEST(Kalman, SlowMotionIsFollowedClosely) {
    for (const double mm_per_second : {5.0, 20.0, 100.0, -50.0}) {
        Wall wall;
        double behind = 0;
        for (int i = 0; i < 90; ++i) {
            const double truth = 1800 + mm_per_second * i / 30;
            wall.next(truth, 1.2);
            if (i >= 30)
                behind += (wall.mean() - truth) / 60;
        }
        EXPECT_LT(std::abs(behind), 2) << mm_per_second << " mm/s";
    }
}

TEST(Kalman, APixelThatMissesAFrameKeepsItsDepthAndNoLonger) {
    Wall wall;
    for (int i = 0; i < 40; ++i)
        wall.next(2000, 0);
    EXPECT_EQ(wall.next(0, 0).pixels[0], 2000);
    EXPECT_EQ(wall.next(0, 0).pixels[0], 0) << "gone for two frames is gone";
}

TEST(Kalman, AStillPixelThatComesAndGoesStaysLonger) {
    Wall wall;
    for (int i = 0; i < 60; ++i)
        wall.next(i % 2 == 0 || i < 40 ? 2000 : 0, 0);
    wall.next(2000, 0);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(wall.next(0, 0).pixels[0], 2000) << i;
    for (int i = 0; i < 15; ++i)
        wall.next(0, 0);
    EXPECT_EQ(wall.out.pixels[0], 0) << "but not for ever";
}

TEST(Kalman, ThePastCountsLessAfterAPauseAndNothingAfterASecond) {
    const auto after = [](Duration pause) {
        Wall wall;
        for (int i = 0; i < 60; ++i)
            wall.next(2000, 0);
        wall.next(2004, 0, pause);
        return wall.mean();
    };
    EXPECT_LE(after(frame_time), 2001);
    EXPECT_GT(after(10 * frame_time), 2002);
    EXPECT_EQ(after(std::chrono::seconds(2)), 2004);
    EXPECT_EQ(after(-frame_time), 2004) << "time that runs backwards";
}

// Frames of a sensor with few distinct depths, 12 mm apart at two metres, filtered by `steady`.
class Steps {
public:
    static constexpr int step = 12;
    // A wall whose pixels are `level(x, y)` steps behind two metres.
    template <class Level>
    const DepthImage& next(Level level, Duration since = frame_time) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                in.view().row(y)[x] = std::uint16_t(2000 + step * level(x, y));
        out = copy_of(chain_.apply(in.view(), since));
        return out;
    }
    std::uint16_t first() const { return out.pixels[0]; }
    DepthImage in{size}, out{size};

private:
    Chain chain_{parse_chain("steady").settings, {.size = size}};
};
constexpr auto level_0 = [](int, int) { return 0; };
// A single pixel that is not like the others.
constexpr auto first_is(int level) {
    return [level](int x, int y) { return x == 0 && y == 0 ? level : 0; };
}

TEST(Steady, FlickerBetweenStepsStandsStillAtAMeasuredDepth) {
    Steps wall;
    std::mt19937 random(4);
    const auto flicker = [&](int, int) { return int(random() % 3) - 1; };
    double changed = 0;
    DepthImage before(size);
    for (int i = 0; i < 60; ++i) {
        wall.next(flicker);
        for (std::size_t p = 0; p < size.area(); ++p) {
            ASSERT_EQ((wall.out.pixels[p] - 2000) % Steps::step, 0) << "a depth of no measurement";
            changed += i > 20 && wall.out.pixels[p] != before.pixels[p];
        }
        before = wall.out;
    }
    EXPECT_LT(changed / (39.0 * double(size.area())), 0.03) << "share of pixels that change";
}

TEST(Steady, AChangeThatLastsIsTakenAndOneThatDoesNotIsNot) {
    Steps wall;
    wall.next(level_0);
    for (int i = 0; i < 24; ++i) {
        wall.next(first_is(i % 8 == 7 ? -1 : 1));
        ASSERT_EQ(wall.first(), 2000) << "frame " << i;
    }
    for (int i = 0; i < 7; ++i) {
        wall.next(first_is(1));
        ASSERT_EQ(wall.first(), 2000);
    }
    wall.next(first_is(1));
    EXPECT_EQ(wall.first(), 2012) << "eight frames on one side";
}

TEST(Steady, ARealStepIsThereAtOnce) {
    Steps wall;
    wall.next(level_0);
    EXPECT_EQ(wall.next(first_is(3)).pixels[0], 2036);
    EXPECT_EQ(wall.next(first_is(0)).pixels[0], 2000);
}

TEST(Steady, ASurfaceThatMovesSlowlyIsFollowedAtOnceAndUntorn) {
    Steps wall;
    for (int i = 0; i < 20; ++i) {
        wall.next([i](int, int) { return i; });
        EXPECT_EQ(wall.out, wall.in) << "frame " << i;
    }
    // Its block alone: the others have not moved.
    const auto in_one_block = [](int x, int y) { return x < 16 && y < 16 ? 20 : 19; };
    EXPECT_EQ(wall.next(in_one_block), wall.in);
    const auto in_half_a_block = [](int x, int y) { return x < 8 && y < 16 ? 21 : 19; };
    wall.next(in_half_a_block);
    EXPECT_EQ(wall.first(), 2000 + 20 * Steps::step) << "half of a block is flicker";
}

TEST(Steady, APixelThatMissesAFrameKeepsItsDepthAndNoLonger) {
    Wall wall("steady");
    wall.next(2000, 0);
    EXPECT_EQ(wall.next(0, 0).pixels[0], 2000);
    EXPECT_EQ(wall.next(0, 0).pixels[0], 0) << "gone for two frames is gone";
}

TEST(Steady, MissedFramesCountAndAfterASecondNothingIsKept) {
    const auto after = [](Duration pause) {
        Steps wall;
        wall.next(level_0);
        return wall.next(first_is(1), pause).pixels[0];
    };
    EXPECT_EQ(after(frame_time), 2000);
    EXPECT_EQ(after(7 * frame_time), 2000);
    EXPECT_EQ(after(8 * frame_time), 2012);
    EXPECT_EQ(after(std::chrono::seconds(2)), 2012);
}

TEST(Steady, TheToleranceGrowsWithTheSquareOfTheDistanceInAnyUnit) {
    // The depth of a pixel at `first_mm` after a wall at `mm`.
    const auto shown = [](double unit_mm, int mm, int first_mm) {
        Chain chain(parse_chain("steady").settings, {.size = size, .depth_unit_mm = unit_mm});
        DepthImage image(size);
        for (auto& pixel : image.pixels)
            pixel = std::uint16_t(mm / unit_mm);
        chain.apply(image.view(), frame_time);
        image.pixels[0] = std::uint16_t(first_mm / unit_mm);
        return chain.apply(image.view(), frame_time).row(0)[0] * unit_mm;
    };
    struct Place {
        int mm, tolerance;
    };
    for (const double unit_mm : {1.0, 0.25})
        for (const Place& at : {Place{1000, 8}, Place{2000, 32}, Place{4000, 128}}) {
            EXPECT_EQ(shown(unit_mm, at.mm, at.mm + at.tolerance - 2), at.mm);
            const int beyond = at.mm + at.tolerance + 3;
            EXPECT_EQ(shown(unit_mm, at.mm, beyond), beyond);
        }
}

TEST(Holes, NothingIsInventedAcrossAnEdge) {
    // A gap of two to eight pixels between two surfaces belongs to neither.
    for (int gap = 2; gap <= 8; ++gap) {
        DepthImage image({60, 40});
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 60; ++x)
                image.view().row(y)[x] = x < 30 ? 1200 : x < 30 + gap ? 0 : 2500;
        Chain chain(parse_chain("holes").settings, {.size = image.size});
        EXPECT_EQ(copy_of(chain.apply(image.view(), frame_time)), image) << "gap of " << gap;
    }
}

TEST(Holes, SmallHolesFillFromTheirRimAndLargeOnesStay) {
    DepthImage image({80, 60});
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const bool small = x >= 10 && x < 17 && y >= 10 && y < 17;
            const bool large = x >= 30 && x < 50 && y >= 20 && y < 40;
            image.view().row(y)[x] = small || large ? 0 : std::uint16_t(1500 + 2 * x + y);
        }
    Chain chain(parse_chain("holes").settings, {.size = image.size});
    const DepthView out = chain.apply(image.view(), frame_time);
    for (int y = 10; y < 17; ++y)
        for (int x = 10; x < 17; ++x)
            EXPECT_NEAR(out.row(y)[x], 1500 + 2 * x + y, 12);
    for (int y = 20; y < 40; ++y)
        for (int x = 30; x < 50; ++x)
            ASSERT_EQ(out.row(y)[x], 0) << x << ", " << y;
}

TEST(FlyingPixels, WhatHangsBetweenTwoSurfacesGoesAndTheSurfacesStay) {
    DepthImage image({40, 30});
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            image.view().row(y)[x] = std::uint16_t(x < 20 ? 1200 : x == 20 ? 1800 + 60 * y : 2500);
    Chain chain(parse_chain("flying_pixels").settings, {.size = image.size});
    const DepthView out = chain.apply(image.view(), frame_time);
    for (int y = 2; y < 28; ++y)
        for (int x = 0; x < 40; ++x) {
            const bool flies = x == 20 && std::abs(1800 + 60 * y - 2500) > 100;
            if (flies || x != 20) {
                ASSERT_EQ(out.row(y)[x], flies ? 0 : image.view().row(y)[x]) << x << ", " << y;
            }
        }
}

}  // namespace
}  // namespace theatron::filter
