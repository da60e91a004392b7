// SPDX-License-Identifier: Apache-2.0
#include "or_screen/layout.h"

#include <gtest/gtest.h>

#include <cmath>

namespace theatron::or_screen {
namespace {

std::vector<Rect> all(const Layout& layout) {
    std::vector<Rect> rects{layout.picture, layout.caption, layout.room};
    if (layout.monitor.width > 0)
        rects.push_back(layout.monitor);
    rects.insert(rects.end(), layout.cards.begin(), layout.cards.end());
    return rects;
}

bool overlap(const Rect& a, const Rect& b) {
    constexpr double rounding = 1e-6;
    return a.x < b.right() - rounding && b.x < a.right() - rounding &&
           a.y < b.bottom() - rounding && b.y < a.bottom() - rounding;
}

TEST(OrScreenLayout, NothingOverlapsOrLeavesTheScreenWhereverItDrifts) {
    for (const Size screen : {Size{1920, 1080}, Size{3840, 2160}, Size{1280, 1024},
                              Size{1080, 1920}, Size{1024, 768}, Size{2560, 1080}})
        for (const Size picture : {Size{}, Size{1280, 720}, Size{640, 576}, Size{2048, 1536}})
            for (std::size_t people = 0; people < 12; ++people)
                for (const bool monitor : {false, true}) {
                    const Layout one = layout({screen, picture, people, monitor});
                    const std::vector<Rect> rects = all(one);
                    const double drifts = largest_drift * one.letter;
                    for (std::size_t i = 0; i < rects.size(); ++i) {
                        EXPECT_GE(rects[i].x, drifts);
                        EXPECT_GE(rects[i].y, drifts);
                        EXPECT_LE(rects[i].right(), screen.width - drifts);
                        EXPECT_LE(rects[i].bottom(), screen.height - drifts);
                        EXPECT_GT(rects[i].width, 2 * one.letter);
                        EXPECT_GT(rects[i].height, one.letter);
                        for (std::size_t j = 0; j < i; ++j)
                            EXPECT_FALSE(overlap(rects[i], rects[j])) << i << " " << j;
                    }
                }
}

TEST(OrScreenLayout, ThePictureKeepsItsProportionsAndHasMostOfAWideScreen) {
    for (const bool monitor : {false, true}) {
        const Layout one = layout({{1920, 1080}, {1280, 720}, 3, monitor});
        EXPECT_NEAR(one.picture.width / one.picture.height, 16.0 / 9, 1e-9);
        EXPECT_GT(one.picture.width * one.picture.height, 0.45 * 1920 * 1080);
    }
}

TEST(OrScreenLayout, TheSmallestLettersAreTwelveMinutesOfArcAtThreeMetres) {
    // A screen of 27 inches, 16:9.
    const double screen_height_mm = 27 * 25.4 * 9 / std::hypot(16, 9);
    const double letter_mm = layout({{1920, 1080}, {}, 1, false}).letter / 1080 * screen_height_mm;
    EXPECT_GT(std::atan(letter_mm / 3000) * 60 * 180 / 3.14159265, 12);
}

TEST(OrScreenLayout, EachPersonHasACardUntilThereAreTooMany) {
    const auto cards = [](std::size_t people) {
        return layout({{1920, 1080}, {1280, 720}, people, false}).cards.size();
    };
    EXPECT_EQ(cards(0), 1u);
    EXPECT_EQ(cards(3), 3u);
    EXPECT_EQ(cards(8), 8u);
    const Layout many = layout({{1920, 1080}, {1280, 720}, 20, false});
    EXPECT_EQ(many.cards.size(), Layout::most_cards);
    // The last card says so.
    EXPECT_EQ(many.left_out, 20 - (Layout::most_cards - 1));
    EXPECT_EQ(layout({{1920, 1080}, {1280, 720}, 8, false}).left_out, 0u);
}

TEST(OrScreenLayout, EverythingDriftsSlowlyAndNowhereForLong) {
    const Layout one = layout({{1920, 1080}, {1280, 720}, 3, true});
    int at_home = 0, seconds = 3600;
    Vec2 least{9, 9}, most{-9, -9};
    for (int s = 0; s < seconds; ++s) {
        const Vec2 now = drift(TimePoint(std::chrono::seconds(s)));
        const Vec2 next = drift(TimePoint(std::chrono::seconds(s + 30)));
        EXPECT_LT(std::hypot(next.x - now.x, next.y - now.y), 1);
        EXPECT_LE(std::max(std::abs(now.x), std::abs(now.y)), largest_drift);
        least = {std::min(least.x, now.x), std::min(least.y, now.y)};
        most = {std::max(most.x, now.x), std::max(most.y, now.y)};
        // A vertical line of four pixels covers the same pixels.
        at_home += std::abs(now.x) * one.letter < 4;
    }
    EXPECT_GT(most.x - least.x, 1.9 * largest_drift);
    EXPECT_GT(most.y - least.y, 1.9 * largest_drift);
    EXPECT_LT(at_home, 0.2 * seconds);
}

TEST(OrScreenLayout, ATextThatIsTooWideGetsSmallerLettersThatCanStillBeRead) {
    EXPECT_EQ(scale_to_fit(100, 200), 1);
    EXPECT_EQ(scale_to_fit(200, 200), 1);
    EXPECT_EQ(scale_to_fit(300, 200), 200.0 / 300);
    EXPECT_EQ(scale_to_fit(3000, 200), 0.45);
}

TEST(OrScreenLayout, ASliceHasItsLettersInsideAndItsTextsBelow) {
    for (const Size screen : {Size{1920, 1080}, Size{1280, 1024}, Size{1080, 1920}})
        for (const Size slice : {Size{512, 512}, Size{512, 200}, Size{200, 512}}) {
            const Layout one = layout({screen, {1280, 720}, 3, true});
            const MonitorPlaces places = monitor_places(one.monitor, slice, 5, one.letter);
            EXPECT_NEAR(places.picture.width / places.picture.height,
                        double(slice.width) / slice.height, 1e-9);
            std::vector<Rect> below(places.lines.begin(), places.lines.end());
            for (const Rect& line : below) {
                EXPECT_FALSE(overlap(line, places.picture));
                EXPECT_GT(line.height, 1.4 * one.letter);
                EXPECT_LE(line.bottom(), one.monitor.bottom() + 1e-9);
            }
            std::vector<Rect> letters;
            for (const Vec2 towards : {Vec2{-1, 0}, Vec2{1, 0}, Vec2{0, -1}, Vec2{0, 1}}) {
                const Rect place = letters_place(places.letters, towards, 1, one.letter);
                EXPECT_GE(place.x, one.monitor.x);
                EXPECT_GE(place.y, one.monitor.y);
                EXPECT_LE(place.right(), one.monitor.right());
                EXPECT_LE(place.bottom(), below[0].y + 1e-9);
                // At the side that they name.
                const double right = place.x + place.width / 2 - places.picture.x -
                                     places.picture.width / 2,
                             down = place.y + place.height / 2 - places.picture.y -
                                    places.picture.height / 2;
                EXPECT_GT(right * towards.x + down * towards.y, 0);
                for (const Rect& other : letters)
                    EXPECT_FALSE(overlap(place, other)) << screen.width << " " << slice.width;
                letters.push_back(place);
            }
        }
}

TEST(OrScreenLayout, LabelsStandBesideTheirPlaceAndCoverNoOther) {
    const Rect area{0, 0, 1000, 500};
    const Rect first = label_place({500, 250}, {100, 30}, 20, area, {});
    EXPECT_EQ(first, (Rect{520, 270, 100, 30}));
    std::vector<Rect> there;
    for (int i = 0; i < 8; ++i) {
        const Rect next = label_place({500, 250}, {100, 30}, 20, area, there);
        for (const Rect& other : there)
            EXPECT_FALSE(overlap(next, other)) << i;
        there.push_back(next);
    }
    // In a corner, and where it is larger than the area.
    EXPECT_EQ(label_place({995, 495}, {100, 30}, 20, area, {}).right(), 1000);
    EXPECT_EQ(label_place({0, 0}, {2000, 30}, 20, area, {}).x, 0);
}

TEST(OrScreenLayout, FittedKeepsProportionsInTheMiddle) {
    const Rect rect = fitted({4, 3}, {10, 20, 200, 90});
    EXPECT_EQ(rect, (Rect{50, 20, 120, 90}));
}

}  // namespace
}  // namespace theatron::or_screen
