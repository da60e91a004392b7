// SPDX-License-Identifier: Apache-2.0
#include "net/loss_watch.h"

#include <gtest/gtest.h>

namespace theatron::net {
namespace {

TEST(LossWatch, LossesNowAndThenAreALosingLink) {
    LossWatch watch;
    TimePoint now = from_us(1'000'000);
    EXPECT_FALSE(watch.note(1, now));
    EXPECT_FALSE(watch.note(2, now += 700ms));
    EXPECT_TRUE(watch.note(3, now += 700ms));
    EXPECT_TRUE(watch.note(3, now += 1h));
}

TEST(LossWatch, ManyPacketsAtOnceAreOneEvent) {
    LossWatch watch;
    TimePoint now = from_us(1'000'000);
    for (std::uint32_t lost = 1; lost < 30; ++lost)
        EXPECT_FALSE(watch.note(lost, now += 4ms));
    EXPECT_FALSE(watch.note(200, now += 9s));
}

TEST(LossWatch, RareLossesAreNone) {
    LossWatch watch;
    TimePoint now = from_us(1'000'000);
    for (std::uint32_t lost = 1; lost < 100; ++lost)
        EXPECT_FALSE(watch.note(lost, now += 6s));
}

}  // namespace
}  // namespace theatron::net
