// SPDX-License-Identifier: Apache-2.0
#include "photon/strip_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "photon/dark_regions.h"

namespace theatron::photon {
namespace {

constexpr StripTime time_shown = 43'210;

GreyImage plain(Size size, std::uint8_t brightness) {
    GreyImage grey(size);
    std::fill(grey.pixels.begin(), grey.pixels.end(), brightness);
    return grey;
}

// A strip whose outer corners are seen at `place`.
void put_strip(GreyImage& grey, StripTime time, const Quad& place, int black = 20,
               int white = 220) {
    const PlaneMap map(place, {0, 0}, {strip_width, strip_height});
    const StripCells cells = cells_of(time);
    constexpr int shares = 4;
    const auto [left, right] = std::minmax({place[0].x, place[1].x, place[2].x, place[3].x});
    const auto [top, bottom] = std::minmax({place[0].y, place[1].y, place[2].y, place[3].y});
    for (int y = int(top); y < std::min(int(bottom) + 1, grey.size.height); ++y)
        for (int x = int(left); x < std::min(int(right) + 1, grey.size.width); ++x) {
            int sum = 0;
            for (int i = 0; i < shares * shares; ++i) {
                const Point at = map.to_plane(
                    {x + (i % shares + 0.5) / shares, y + (i / shares + 0.5) / shares});
                const bool in_strip =
                    at.x >= 0 && at.y >= 0 && at.x < strip_width && at.y < strip_height;
                sum += !in_strip                     ? grey.view().row(y)[x]
                       : is_white(cells, at.x, at.y) ? white
                                                     : black;
            }
            grey.view().row(y)[x] = std::uint8_t(sum / (shares * shares));
        }
}

Quad upright(double left, double top, double cell) {
    const double right = left + strip_width * cell, bottom = top + strip_height * cell;
    return {{{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
}

std::vector<StripTime> times_in(const GreyImage& grey) {
    std::vector<StripTime> times;
    for (const StripReading& strip : find_strips(grey.view()))
        if (strip.time)
            times.push_back(*strip.time);
    return times;
}

const std::vector<StripTime> just_it{time_shown};

TEST(StripFinder, FindsStripsOfAllSizes) {
    for (const double cell : {3.0, 4.3, 7.0, 12.0, 25.0, 60.0}) {
        GreyImage grey = plain({int(cell * 18) + 5, int(cell * 9) + 5}, 120);
        put_strip(grey, time_shown, upright(cell + 0.3, cell + 0.6, cell));
        EXPECT_EQ(times_in(grey), just_it) << cell;
    }
}

TEST(StripFinder, FindsAStripInEveryDirection) {
    Quad place{{{60, 40}, {250, 60}, {240, 140}, {50, 130}}};
    for (int turn = 0; turn < 2; ++turn) {
        GreyImage grey = plain({300, 180}, 90);
        put_strip(grey, time_shown, place);
        EXPECT_EQ(times_in(grey), just_it) << turn;
        std::rotate(place.begin(), place.begin() + 2, place.end());
    }
    GreyImage grey = plain({180, 300}, 90);
    put_strip(grey, time_shown, {{{140, 60}, {130, 250}, {60, 250}, {50, 60}}});
    EXPECT_EQ(times_in(grey), just_it);
}

TEST(StripFinder, FindsAStripAtASlant) {
    GreyImage grey = plain({400, 260}, 90);
    put_strip(grey, time_shown, {{{60, 90}, {330, 40}, {350, 210}, {80, 160}}});
    EXPECT_EQ(times_in(grey), just_it);
}

TEST(StripFinder, FindsAStripOnADarkScreen) {
    GreyImage grey = plain({300, 180}, 3);
    put_strip(grey, time_shown, upright(40, 40, 10), 5, 60);
    EXPECT_EQ(times_in(grey), just_it);
}

TEST(StripFinder, FindsBothStripsFromLeftToRight) {
    GreyImage grey = plain({420, 120}, 120);
    put_strip(grey, 1000, upright(230, 20, 10));
    put_strip(grey, 2000, upright(20, 20, 10));
    EXPECT_EQ(times_in(grey), (std::vector<StripTime>{2000, 1000}));
}

TEST(StripFinder, PutsCornersToAFractionOfAPixel) {
    GreyImage grey = plain({300, 180}, 120);
    put_strip(grey, time_shown, upright(30.25, 40.75, 12.1));
    const auto strips = find_strips(grey.view());
    ASSERT_EQ(strips.size(), 1u);
    EXPECT_NEAR(strips[0].frame[0].x, 30.25 + 12.1, 0.25);
    EXPECT_NEAR(strips[0].frame[0].y, 40.75 + 12.1, 0.25);
    EXPECT_NEAR(strips[0].frame[2].x, 30.25 + 15 * 12.1, 0.25);
    EXPECT_NEAR(strips[0].frame[2].y, 40.75 + 6 * 12.1, 0.25);
    EXPECT_NEAR(strips[0].contrast, 200, 5);
}

TEST(StripFinder, ReadsTheTimeThatWasSeenForLonger) {
    const Quad place = upright(40, 40, 10);
    GreyImage earlier = plain({300, 180}, 120), later = earlier;
    put_strip(earlier, 5000, place);
    put_strip(later, 5017, place);
    for (const int share : {30, 48, 52, 70}) {
        GreyImage mixed = earlier;
        for (std::size_t i = 0; i < mixed.pixels.size(); ++i)
            mixed.pixels[i] =
                std::uint8_t((earlier.pixels[i] * (100 - share) + later.pixels[i] * share) / 100);
        EXPECT_EQ(times_in(mixed), std::vector<StripTime>{StripTime(share > 50 ? 5017 : 5000)})
            << share;
    }
}

TEST(StripFinder, KnowsAStripWhoseTimeCannotBeRead) {
    // Three times, each with a third of the light.
    const Quad place = upright(40, 40, 10);
    std::vector<GreyImage> parts(3, plain({300, 180}, 120));
    for (int i = 0; i < 3; ++i)
        put_strip(parts[std::size_t(i)], StripTime(5000 + 17 * i), place);
    GreyImage mixed = parts[0];
    for (std::size_t i = 0; i < mixed.pixels.size(); ++i)
        mixed.pixels[i] =
            std::uint8_t((parts[0].pixels[i] + parts[1].pixels[i] + parts[2].pixels[i]) / 3);
    const auto strips = find_strips(mixed.view());
    ASSERT_EQ(strips.size(), 1u);
    EXPECT_FALSE(strips[0].time);
}

TEST(StripFinder, FindsNothingInNoiseOrSmallPictures) {
    std::mt19937 random(3);
    GreyImage grey({320, 200});
    for (std::uint8_t& pixel : grey.pixels)
        pixel = std::uint8_t(random());
    EXPECT_TRUE(find_strips(grey.view()).empty());
    for (const Size size : {Size{1, 1}, Size{1, 300}, Size{300, 1}, Size{15, 15}, Size{17, 17}})
        EXPECT_TRUE(find_strips(plain(size, 0).view()).empty());
}

TEST(StripFinder, FollowsStripsThroughAFilm) {
    StripFinder finder;
    for (int i = 0; i < 80; ++i) {
        GreyImage grey = plain({420, 120}, 120);
        put_strip(grey, StripTime(100 * i), upright(20 + 0.5 * i, 20, 9));
        if (i >= 5)
            put_strip(grey, StripTime(100 * i + 50), upright(230, 20, 10));
        const auto strips = finder.find(grey.view());
        ASSERT_EQ(strips.size(), i < 5 ? 1u : 2u) << i;
        EXPECT_EQ(strips[0].time, StripTime(100 * i));
    }
}

}  // namespace
}  // namespace theatron::photon
