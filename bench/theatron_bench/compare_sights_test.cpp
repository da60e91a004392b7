// SPDX-License-Identifier: Apache-2.0
#include "compare_sights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace theatron::bench {
namespace {

constexpr Size picture_size{80, 40};
constexpr Vec3 sights_up{0, 1, 0};

// A wall 2 m before an expert at the room's origin, who looks along z; 80 pixels are 90 degrees
// wide, and 4 m of the wall.
struct SightWall {
    Calibration expert;
    DepthImage exact_mm{picture_size};
    Image<std::uint8_t> everywhere{picture_size};

    SightWall() {
        expert.depth = pinhole(picture_size, 90);
        expert.room_from_camera = look_at({0, 0, 0}, {0, 0, 1}, sights_up);
        std::fill(exact_mm.pixels.begin(), exact_mm.pixels.end(), std::uint16_t(2000));
        std::fill(everywhere.pixels.begin(), everywhere.pixels.end(), std::uint8_t(1));
    }
    ExactSurfaces surfaces() const {
        return {render::view_of_camera(expert.depth, expert.room_from_camera, picture_size),
                exact_mm.view()};
    }
    View<const std::uint8_t> all() const { return everywhere.view(); }
    // The size of all pixels.
    Image<float> details(float mm) const {
        Image<float> details(picture_size);
        std::fill(details.pixels.begin(), details.pixels.end(), mm);
        return details;
    }
};

// Sees the wall from `metres` before it, unless `near_m` away something hides all.
struct WallCamera {
    Image<float> exact_m{picture_size};
    SightCamera sight;

    WallCamera(double metres, float exact) {
        std::fill(exact_m.pixels.begin(), exact_m.pixels.end(), exact);
        sight.lens = pinhole(picture_size, 90);
        sight.room_from_lens = look_at({0, 0, 2 - metres}, {0, 0, 3}, sights_up);
        sight.exact_m = std::as_const(exact_m).view();
    }
};

TEST(CompareSights, TheDetailIsThatOfTheFinestCameraThatSeesTheSurface) {
    const SightWall wall;
    const WallCamera far(2, 2), near(1, 1), hidden(0.5, 0.2F);
    const auto detail = [&](std::vector<SightCamera> cameras, int x) {
        return finest_details(wall.surfaces(), cameras).view().row(20)[x];
    };
    EXPECT_NEAR(detail({far.sight}, 40), 50, 0.1);
    EXPECT_NEAR(detail({far.sight, near.sight}, 40), 25, 0.1);
    EXPECT_NEAR(detail({far.sight, near.sight}, 5), 50, 0.1);  // beside the near one's picture
    EXPECT_EQ(detail({hidden.sight}, 40), 0);
    EXPECT_EQ(detail({near.sight}, 5), 0);
}

TEST(CompareSights, ARasterAndAGridMakeDetailCoarser) {
    const SightWall wall;
    WallCamera camera(2, 2);
    const auto detail = [&] {
        return finest_details(wall.surfaces(), {camera.sight}).view().row(20)[40];
    };
    camera.sight.coarsest_mm_at_1m = 40;
    EXPECT_NEAR(detail(), 80, 0.1);
    camera.sight.grid_mm = 100;
    EXPECT_NEAR(detail(), 100, 0.1);
}

TEST(CompareSights, DistancesMayBeCoarserThanPictures) {
    const SightWall wall;
    WallCamera camera(2, 2);
    camera.sight.lens = scaled(camera.sight.lens, {160, 80});
    EXPECT_NEAR(finest_details(wall.surfaces(), {camera.sight}).view().row(20)[40], 25, 0.1);
}

TEST(CompareSights, AVideoCallShowsWhatItsCameraSeesAndNothingFalsely) {
    const SightWall wall;
    const WallCamera near(1, 1);
    const CompareShares shares =
        shares_of(sights_of_video(wall.surfaces(), finest_details(wall.surfaces(), {near.sight})),
                  wall.all());
    // Half of the width and of the height, but for a pixel at each border.
    EXPECT_NEAR(shares.rightly_percent, 25, 2);
    EXPECT_EQ(shares.wrongly_percent, 0);
    EXPECT_NEAR(shares.rightly_percent + shares.hidden_percent, 100, 1e-9);
    EXPECT_NEAR(shares.detail_mm, 25, 0.1);
}

TEST(CompareSights, WhatIsDrawnElsewhereIsShownWronglyOnBothSides) {
    const SightWall wall;
    DepthImage drawn = wall.exact_mm;
    for (int y = 0; y < picture_size.height; ++y) {
        std::uint16_t* row = drawn.view().row(y);
        std::fill_n(row, 20, std::uint16_t(0));
        std::fill_n(row + 20, 20, std::uint16_t(2000 + shown_within_mm + 1));
        std::fill_n(row + 40, 10, std::uint16_t(2000 - shown_within_mm - 1));
        std::fill_n(row + 50, 10, std::uint16_t(2000 + shown_within_mm));
    }
    const CompareShares shares =
        shares_of(sights_of_drawn(wall.surfaces(), drawn.view(), wall.details(0.5F)), wall.all());
    EXPECT_NEAR(shares.hidden_percent, 25, 1e-9);
    EXPECT_NEAR(shares.wrongly_percent, 37.5, 1e-9);
    EXPECT_NEAR(shares.rightly_percent, 37.5, 1e-9);
    EXPECT_NEAR(shares.finely_percent, 37.5, 1e-9);
}

TEST(CompareSights, CoarsePixelsAreNotFine) {
    const SightWall wall;
    const CompareShares shares = shares_of(
        sights_of_drawn(wall.surfaces(), wall.exact_mm.view(), wall.details(1.1F)), wall.all());
    EXPECT_EQ(shares.rightly_percent, 100);
    EXPECT_EQ(shares.finely_percent, 0);
}

TEST(CompareSights, WhereNothingIsNothingCounts) {
    SightWall wall;
    std::fill_n(wall.exact_mm.pixels.begin(), wall.exact_mm.pixels.size() / 2, std::uint16_t(0));
    const DepthImage nothing(picture_size);
    EXPECT_EQ(
        shares_of(sights_of_drawn(wall.surfaces(), nothing.view(), wall.details(1)), wall.all())
            .hidden_percent,
        100);
}

TEST(CompareSights, OfTwoPicturesTheBetterOneCounts) {
    const auto one_pixel = [](Seen seen, float mm) {
        CompareSights sights{Image<Seen>({1, 1}), Image<float>({1, 1})};
        sights.seen.pixels[0] = seen;
        sights.detail_mm.pixels[0] = mm;
        return sights;
    };
    const CompareSights coarse = one_pixel(Seen::rightly, 3), fine = one_pixel(Seen::rightly, 0.5F),
                        wrong = one_pixel(Seen::wrongly, 2), hidden = one_pixel(Seen::hidden, 0);
    const auto seen = [](const CompareSights& sights) { return sights.seen.pixels[0]; };
    EXPECT_EQ(seen(sights_of_both(wrong, fine)), Seen::rightly);
    EXPECT_EQ(seen(sights_of_both(hidden, wrong)), Seen::wrongly);
    EXPECT_EQ(seen(sights_of_both(hidden, hidden)), Seen::hidden);
    EXPECT_EQ(sights_of_both(coarse, fine).detail_mm.pixels[0], 0.5F);
    // The finer camera's pixels do not help where its picture is wrong.
    EXPECT_EQ(sights_of_both(coarse, wrong).detail_mm.pixels[0], 3);
}

TEST(CompareSights, TheRegionIsADiscAroundThePoint) {
    const SightWall wall;
    const Image<std::uint8_t> region =
        region_around(wall.surfaces().view, picture_size, {0, 0, 2}, 1);
    const auto pixels = std::count(region.pixels.begin(), region.pixels.end(), 1);
    // A line of sight 14.5 degrees off passes 0.5 m beside the point: 10.3 pixels from the middle.
    EXPECT_NEAR(double(pixels), 335, 10);
    EXPECT_TRUE(region.view().row(20)[40]);
    EXPECT_FALSE(region.view().row(20)[52]);
}

TEST(CompareSights, MarksLieWhereThePictureIsWrongOrEmpty) {
    const Size size{30, 30};
    CompareSights sights{Image<Seen>(size), Image<float>(size)};
    const Image<std::uint8_t> nowhere(size);
    const auto changed = [&](Seen seen) {
        std::fill(sights.seen.pixels.begin(), sights.seen.pixels.end(), seen);
        const ColorImage picture = marked(ColorImage(size), sights, nowhere.view());
        return std::count_if(picture.pixels.begin(), picture.pixels.end(),
                             [](Rgb pixel) { return pixel != Rgb{}; });
    };
    EXPECT_EQ(changed(Seen::rightly), 0);
    EXPECT_EQ(changed(Seen::nothing_there), 0);
    // Stripes, so that the picture is seen between them.
    for (const Seen seen : {Seen::wrongly, Seen::hidden}) {
        EXPECT_GT(changed(seen), 200);
        EXPECT_LT(changed(seen), 600);
    }
}

}  // namespace
}  // namespace theatron::bench
