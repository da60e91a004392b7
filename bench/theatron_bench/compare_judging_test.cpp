// SPDX-License-Identifier: Apache-2.0
#include "compare_judging.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::bench {
namespace {

constexpr Size judged_size{64, 32};
constexpr std::uint16_t judged_wall_mm = 1000;

Image<std::uint8_t> half_mask(bool left, bool right) {
    Image<std::uint8_t> all(judged_size);
    for (int y = 0; y < judged_size.height; ++y)
        for (int x = 0; x < judged_size.width; ++x)
            all.view().row(y)[x] = x < judged_size.width / 2 ? left : right;
    return all;
}

DepthImage judged_wall() {
    DepthImage depth(judged_size);
    std::fill(depth.pixels.begin(), depth.pixels.end(), judged_wall_mm);
    return depth;
}

// A wall; a camera sees its left half alone.
ViewBenchPlace half_seen() {
    ViewBenchPlace place;
    place.view = {.room_from_eye = {}, .left = -1, .right = 1, .top = -0.5, .bottom = 0.5};
    place.exact_mm = judged_wall();
    place.exact_color = ColorImage(judged_size);
    place.seen = half_mask(true, false);
    place.instrument = half_mask(false, false);
    return place;
}

render::Picture drawn(const DepthImage& depth_mm) {
    render::Picture picture;
    picture.color = ColorImage(judged_size);
    picture.depth_mm = depth_mm;
    return picture;
}

CompareMethod judged(const DepthImage& place_mm, const DepthImage& close_up_mm) {
    CompareMethod method;
    judge(method, {{half_seen()}, half_seen()}, {{drawn(place_mm)}, drawn(close_up_mm)}, {});
    return method;
}

TEST(CompareJudging, TheExactPictureHasNoFaults) {
    const CompareMethod method = judged(judged_wall(), judged_wall());
    ASSERT_TRUE(method.expert && method.close_up && method.close_up->likeness);
    for (const CompareLikeness& likeness : {*method.expert, *method.close_up->likeness}) {
        EXPECT_EQ(likeness.holes_percent, 0);
        EXPECT_EQ(likeness.undrawn_percent, 0);
        EXPECT_EQ(likeness.see_through_percent, 0);
        EXPECT_EQ(likeness.ssim, 1);
    }
    EXPECT_EQ(method.pictures.size(), 1u);
    EXPECT_EQ(method.from_place.size(), 1u);
}

TEST(CompareJudging, WhatIsNotDrawnIsDarkAndAHoleWhereACameraSeesIt) {
    const CompareMethod method = judged(DepthImage(judged_size), judged_wall());
    EXPECT_EQ(method.expert->undrawn_percent, 100);
    EXPECT_EQ(method.expert->undrawn_unseen_percent, 50);
    EXPECT_EQ(method.expert->holes_percent, 100);
    EXPECT_EQ(method.close_up->likeness->undrawn_percent, 0);
}

TEST(CompareJudging, SomethingBehindIsSeenThrough) {
    DepthImage behind = judged_wall();
    for (int y = 0; y < judged_size.height; ++y)
        std::fill_n(behind.view().row(y) + judged_size.width / 2, judged_size.width / 2,
                    std::uint16_t(2 * judged_wall_mm));
    const CompareMethod method = judged(judged_wall(), behind);
    EXPECT_EQ(method.expert->see_through_percent, 0);
    EXPECT_EQ(method.close_up->likeness->see_through_percent, 50);
    ASSERT_TRUE(method.close_up->see_through);
    EXPECT_EQ(method.close_up->see_through->no_camera, 50);
}

TEST(CompareJudging, ThePictureItselfIsAlike) {
    ColorImage picture(judged_size);
    const CompareOwnView same = own_view_of(picture, picture);
    EXPECT_EQ(same.ssim, 1);
    ColorImage other = picture;
    std::fill_n(other.pixels.begin(), 100, Rgb{255, 255, 255});
    EXPECT_LT(own_view_of(picture, other).ssim, 1);
    EXPECT_LT(own_view_of(picture, other).psnr_db, same.psnr_db);
}

}  // namespace
}  // namespace theatron::bench
