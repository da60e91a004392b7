// SPDX-License-Identifier: Apache-2.0
#include "photon/strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "image/image.h"

namespace theatron::photon {
namespace {

std::string text_of(const StripCells& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i)
        text += std::string(i > 0 && i % strip_columns == 0 ? "/" : "") + (cells[i] ? '#' : '.');
    return text;
}

int cells_between(StripTime a, StripTime b, std::size_t first, std::size_t last) {
    const StripCells one = cells_of(a), other = cells_of(b);
    int count = 0;
    for (std::size_t i = first; i < last; ++i)
        count += one[i] != other[i];
    return count;
}

TEST(Strip, CellsStayAsTheyAre) {
    EXPECT_EQ(text_of(cells_of(0)), "#.........../.....#...###/#...#.......");
    EXPECT_EQ(text_of(cells_of(12345)), "##.#..#...../..#.##...###/##.##.##....");
}

TEST(Strip, EveryTimeIsReadBack) {
    for (int time = 0; time < strip_wrap_ms; ++time)
        ASSERT_EQ(time_of(cells_of(StripTime(time))), StripTime(time));
}

TEST(Strip, NeighboursDifferInOneCellOfTheTime) {
    // The first 16 cells that are not fixed: ten of the first row and six of the second.
    for (int time = 0; time < strip_wrap_ms; ++time)
        ASSERT_EQ(cells_between(StripTime(time), StripTime(time + 1), 0, strip_columns + 9), 1)
            << time;
}

TEST(Strip, RefusesEachSingleWrongCell) {
    for (int time = 0; time < strip_wrap_ms; time += 257)
        for (std::size_t i = 0; i < StripCells().size(); ++i) {
            StripCells cells = cells_of(StripTime(time));
            cells[i] = !cells[i];
            EXPECT_FALSE(time_of(cells)) << time << " cell " << i;
        }
}

TEST(Strip, RefusesAStripThatIsUpsideDown) {
    for (int time = 0; time < strip_wrap_ms; time += 257) {
        StripCells cells = cells_of(StripTime(time));
        std::reverse(cells.begin(), cells.end());
        EXPECT_FALSE(time_of(cells)) << time;
    }
}

TEST(Strip, TwoTimesAreKnownByTheCellsThatDiffer) {
    int known = 0, count = 0;
    for (int time = 0; time < strip_wrap_ms; time += 101, ++count) {
        const auto later = StripTime(time + 17);
        const StripCells one = cells_of(StripTime(time)), other = cells_of(later);
        StripCells is_changing{}, cells = one;
        for (std::size_t i = 0; i < one.size(); ++i) {
            is_changing[i] = one[i] != other[i];
            cells[i] = is_changing[i] ? i % 2 == 0 : one[i];
        }
        const auto change = changing_times_of(cells, is_changing);
        if (!change)
            continue;
        ++known;
        EXPECT_EQ(change->earlier, StripTime(time));
        EXPECT_EQ(change->later, later);
    }
    EXPECT_GT(known, count * 9 / 10);
}

TEST(Strip, OneTimeIsNoChange) {
    EXPECT_FALSE(changing_times_of(cells_of(7), {}));
}

TEST(Strip, IsDrawnWithItsBorderFrameAndCells) {
    ColorImage picture({strip_width * 3, strip_height * 3});
    draw_strip(12345, picture.view());
    const StripCells cells = cells_of(12345);
    const Rgb white{255, 255, 255}, black{};
    for (int y = 0; y < strip_height; ++y)
        for (int x = 0; x < strip_width; ++x) {
            const bool border = x == 0 || y == 0 || x == strip_width - 1 || y == strip_height - 1;
            const bool inside = x > 1 && y > 1 && x < strip_width - 2 && y < strip_height - 2;
            const bool expected =
                border || (inside && cells[std::size_t((y - 2) * strip_columns + x - 2)]);
            EXPECT_EQ(picture.view().row(3 * y + 1)[3 * x + 1], expected ? white : black)
                << x << ", " << y;
        }
}

TEST(Strip, DifferencesWrapAround) {
    EXPECT_EQ(difference_ms(5, 65535), 6);
    EXPECT_EQ(difference_ms(65535, 5), -6);
    EXPECT_EQ(difference_ms(40'000, 10'000), 30'000);
}

TEST(Strip, AgesAreThoseOfTheClock) {
    const TimePoint shown = from_us(65'530'250);
    EXPECT_EQ(strip_time_at(shown), 65'530);
    EXPECT_NEAR(age_ms(shown + 20ms, strip_time_at(shown)), 20, 0.5);
    EXPECT_NEAR(age_ms(shown - 3ms, strip_time_at(shown)), -3, 0.5);
}

}  // namespace
}  // namespace theatron::photon
