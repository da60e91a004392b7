// SPDX-License-Identifier: Apache-2.0
#include "compare_judging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

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

// Its right half is close to the wound.
CompareViews half_seen_views() {
    return {{half_seen()}, half_seen(), half_mask(false, true)};
}

render::Picture drawn(const DepthImage& depth_mm) {
    render::Picture picture;
    picture.color = ColorImage(judged_size);
    picture.depth_mm = depth_mm;
    return picture;
}

CompareMethod judged(const DepthImage& place_mm, const DepthImage& close_up_mm) {
    CompareMethod method;
    judge(method, half_seen_views(), {{drawn(place_mm)}, drawn(close_up_mm)}, {},
          Image<float>(judged_size));
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

TEST(CompareJudging, TheWoundHasItsSharesAndTheirCauses) {
    DepthImage behind = judged_wall();
    for (int y = 0; y < judged_size.height; ++y)
        std::fill_n(behind.view().row(y), judged_size.width * 3 / 4,
                    std::uint16_t(judged_wall_mm + 30));
    const CompareMethod method = judged(judged_wall(), behind);
    ASSERT_TRUE(method.wound && method.wound->lost);
    EXPECT_EQ(method.wound->near.wrongly_percent, 50);
    EXPECT_EQ(method.wound->near.rightly_percent, 50);
    EXPECT_EQ(method.wound->whole.wrongly_percent, 75);
    EXPECT_EQ(method.wound->lost->no_camera, 50);
    EXPECT_EQ(method.wound->lost->sum(), 50);
}

TEST(CompareJudging, AVideoCallAndAPairHaveSharesWithoutCauses) {
    CompareMethod call, pair;
    Image<float> details(judged_size);
    std::fill(details.pixels.begin(), details.pixels.end(), 0.5F);
    judge_video(call, half_seen_views(), std::move(details));
    ASSERT_TRUE(call.wound);
    EXPECT_EQ(call.wound->near.rightly_percent, 100);
    EXPECT_FALSE(call.wound->lost);
    const CompareMethod dark = judged(judged_wall(), DepthImage(judged_size));
    EXPECT_EQ(dark.wound->near.hidden_percent, 100);
    judge_pair(pair, half_seen_views(), dark, call);
    ASSERT_TRUE(pair.wound);
    EXPECT_EQ(pair.wound->near.finely_percent, 100);
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
