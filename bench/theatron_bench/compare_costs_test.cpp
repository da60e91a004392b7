// SPDX-License-Identifier: Apache-2.0
#include "compare_costs.h"

#include <gtest/gtest.h>

namespace theatron::bench {
namespace {

CompareMethod with_costs(const std::vector<std::vector<PictureCost>>& cameras,
                         const std::vector<CompareLink>& links = {}) {
    CompareMethod method;
    add_costs(method, cameras, links);
    return method;
}

TEST(CompareCosts, TheFirstPictureDoesNotCountAndCamerasAreAveraged) {
    const CompareMethod method = with_costs({{{100'000, 50, 40}, {1000, 4, 1}, {3000, 6, 3}},
                                             {{90'000, 9, 9}, {5000, 8, 5}, {7000, 10, 7}}});
    EXPECT_EQ(method.cameras, 2);
    EXPECT_DOUBLE_EQ(method.mbit_per_camera, 4000 * 8 * 30 / 1e6);
    EXPECT_DOUBLE_EQ(method.mbit_of_all(), 2 * 4000 * 8 * 30 / 1e6);
    EXPECT_DOUBLE_EQ(method.sender_ms, 8);          // of 4, 6, 8, 10: the upper one
    EXPECT_DOUBLE_EQ(method.receiver_ms, 5);        // of 1, 3, 5, 7
    EXPECT_DOUBLE_EQ(method.sender_of_all_ms, 16);  // of 4 + 8, 6 + 10
    EXPECT_DOUBLE_EQ(method.receiver_of_all_ms, 10);
}

TEST(CompareCosts, WorkAtOnceIsSharedOutAsEachCameraNeededAlone) {
    std::vector<std::vector<PictureCost>> cameras = {{{100}, {300}}, {{50}, {70}}};
    share_out(cameras, {{0, 40, 9}, {0, 20, 0}}, {{{7, 3, 2}, {7, 0, 0}}, {{7, 1, 1}, {7, 0, 0}}});
    EXPECT_DOUBLE_EQ(cameras[0][0].sender_ms, 30);
    EXPECT_DOUBLE_EQ(cameras[1][0].sender_ms, 10);
    EXPECT_DOUBLE_EQ(cameras[0][0].receiver_ms, 6);
    EXPECT_DOUBLE_EQ(cameras[1][1].sender_ms, 10);
    EXPECT_EQ(cameras[0][1].bytes, 300u);
}

TEST(CompareCosts, ASinglePictureCounts) {
    const CompareMethod method = with_costs({{{2000, 5, 2}}});
    EXPECT_DOUBLE_EQ(method.mbit_per_camera, 2000 * 8 * 30 / 1e6);
    EXPECT_DOUBLE_EQ(method.sender_ms, 5);
}

TEST(CompareCosts, OverALinkBytesOfAllCamerasGoTogetherAndTheSlowestDecides) {
    const std::vector<PictureCost> slow(3, {10'000, 5, 2}), quick(3, {2500, 1, 3});
    const CompareMethod method = with_costs({slow, quick}, {{1000, 10}});
    ASSERT_EQ(method.links.size(), 1u);
    // 5 ms, 12,500 bytes at 1 Gbit/s, 10 ms on the way, 3 ms.
    EXPECT_NEAR(method.links[0].delay_ms, 5 + 0.1 + 10 + 3, 0.01);
    EXPECT_NEAR(method.links[0].pictures_per_s, 30, 0.2);
}

}  // namespace
}  // namespace theatron::bench
