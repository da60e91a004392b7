// SPDX-License-Identifier: Apache-2.0
#include "compare_link.h"

#include <gtest/gtest.h>

namespace theatron::bench {
namespace {

TEST(CompareLink, DelayIsTheSumOfItsPartsWhereNothingWaits) {
    // 25,000 bytes at 20 Mbit/s take 10 ms.
    const LinkFigures f = sent_over({20, 20}, {{25'000, 3, 2}, {25'000, 3, 2}}, 30);
    EXPECT_NEAR(f.delay_ms, 3 + 10 + 20 + 2, 0.1);
    EXPECT_NEAR(f.delay_p95_ms, f.delay_ms, 0.1);
    EXPECT_NEAR(f.pictures_per_s, 30, 0.1);
}

TEST(CompareLink, ASlowLinkCarriesFewerPicturesWithoutAGrowingQueue) {
    // 250,000 bytes at 20 Mbit/s take 100 ms.
    const LinkFigures f = sent_over({20, 20}, {{250'000, 3, 2}, {250'000, 3, 2}}, 30);
    EXPECT_NEAR(f.pictures_per_s, 10, 0.3);
    EXPECT_GE(f.delay_ms, 125);
    EXPECT_LE(f.delay_p95_ms, 125 + 34);
}

TEST(CompareLink, ASlowSenderAndASlowReceiverLeaveOutPictures) {
    EXPECT_NEAR(sent_over({100, 5}, {{1000, 100, 1}, {1000, 100, 1}}, 30).pictures_per_s, 10, 0.8);
    const LinkFigures receiver = sent_over({100, 5}, {{1000, 1, 100}, {1000, 1, 100}}, 30);
    EXPECT_NEAR(receiver.pictures_per_s, 10, 0.8);
    EXPECT_LE(receiver.delay_p95_ms, 1 + 5 + 34 + 100 + 1);
}

TEST(CompareLink, TheFirstMomentIsSentOnce) {
    const LinkFigures f = sent_over({20, 20}, {{250'000, 0, 0}, {2'500, 0, 0}, {2'500, 0, 0}}, 30);
    EXPECT_NEAR(f.delay_p95_ms, 21, 0.1);
    EXPECT_GT(f.pictures_per_s, 29);
}

TEST(CompareLink, OneMomentIsEnough) {
    EXPECT_NEAR(sent_over({20, 20}, {{2'500, 0, 0}}, 30).delay_ms, 21, 0.1);
}

}  // namespace
}  // namespace theatron::bench
