// SPDX-License-Identifier: Apache-2.0
#include "voice/device_pace.h"

#include <gtest/gtest.h>

namespace theatron::voice {
namespace {

constexpr std::size_t ten_ms = 480;

TEST(DevicePace, ForetellsTheNextBlocks) {
    DevicePace pace;
    EXPECT_FALSE(pace.is_known());
    EXPECT_EQ(pace.asked_until(from_us(1'000'000)), 0u);
    pace.note(ten_ms, from_us(0));
    EXPECT_EQ(pace.block(), ten_ms);
    EXPECT_EQ(pace.asked_until(from_us(9'999)), 0u);
    EXPECT_EQ(pace.asked_until(from_us(10'000)), ten_ms);
    EXPECT_EQ(pace.asked_until(from_us(25'000)), 2 * ten_ms);
    EXPECT_EQ(pace.time_of(0), from_us(10'000));
    EXPECT_EQ(pace.time_of(ten_ms - 1), from_us(10'000));
    EXPECT_EQ(pace.time_of(ten_ms), from_us(20'000));
}

TEST(DevicePace, ALateCallMovesTheNextOneByLittle) {
    DevicePace pace;
    for (int i = 0; i < 10; ++i)
        pace.note(ten_ms, from_us(i * 10'000));
    pace.note(ten_ms, from_us(107'000));
    EXPECT_EQ(pace.time_of(0), from_us(110'020));
    pace.note(ten_ms, from_us(110'000));
    EXPECT_EQ(pace.time_of(0), from_us(120'000));
}

TEST(DevicePace, ADeviceThatTakesTwoBlocksAtOnceIsForetoldFromItsEarliestCalls) {
    DevicePace pace;
    for (int i = 0; i < 10; ++i) {
        pace.note(ten_ms, from_us(i * 20'000));
        pace.note(ten_ms, from_us(i * 20'000 + 100));
    }
    // The next two come at 200.0 and 200.1 ms.
    EXPECT_EQ(pace.asked_until(from_us(200'200)), 2 * ten_ms);
    EXPECT_LE(pace.asked_until(from_us(189'000)), ten_ms);
}

TEST(DevicePace, FollowsASlowerAndAFasterClock) {
    for (const double share : {1.0002, 0.9998}) {
        DevicePace pace;
        double at_us = 0;
        for (int i = 0; i < 10'000; ++i, at_us += 10'000 * share)
            pace.note(ten_ms, from_us(std::int64_t(at_us)));
        EXPECT_NEAR(double(to_us(pace.time_of(0))), at_us, 5);
    }
}

TEST(DevicePace, ADeviceThatStoodStillBeginsAnew) {
    DevicePace pace;
    pace.note(ten_ms, from_us(0));
    pace.note(ten_ms, from_us(70'000));
    EXPECT_EQ(pace.time_of(0), from_us(80'000));
}

TEST(DevicePace, TheLargestOfTheLastBlocksIsExpected) {
    DevicePace pace;
    double at_us = 0;
    const auto call = [&](std::size_t samples) {
        pace.note(samples, from_us(std::int64_t(at_us)));
        at_us += double(samples) / 0.048;
    };
    for (int i = 0; i < 8; ++i) {
        call(441);
        call(939);
    }
    EXPECT_EQ(pace.block(), 939u);
    EXPECT_NEAR(double(to_us(pace.time_of(0))), at_us, 3);
    for (int i = 0; i < 16; ++i)
        call(441);
    EXPECT_EQ(pace.block(), 441u);
}

}  // namespace
}  // namespace theatron::voice
