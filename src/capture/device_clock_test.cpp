// SPDX-License-Identifier: Apache-2.0
#include "capture/device_clock.h"

#include <gtest/gtest.h>

#include <random>

namespace theatron::capture {
namespace {

// Steady clock: an hour after boot. Wall clock: an arbitrary day.
constexpr HostNow now{from_us(3'600'000'000), Duration(1'700'000'000'000'000)};

std::uint64_t ns(Duration time) {
    return std::uint64_t(time.count()) * 1000;
}

TEST(HostTime, UnderstandsWhatTheLibrariesCount) {
    const Duration since_boot = now.steady.time_since_epoch();
    EXPECT_EQ(host_time(ns(since_boot - 12ms), now, 33ms), now.steady - 12ms);
    EXPECT_EQ(host_time(ns(now.since_1970 - 12ms), now, 33ms), now.steady - 12ms);
}

TEST(HostTime, TakesTheUsualDelayWhereTheStampMeansNothing) {
    for (const std::uint64_t stamp :
         {std::uint64_t(0), std::uint64_t(1), ~std::uint64_t(0), ns(now.since_1970 + 5ms),
          ns(now.since_1970 - 2s), ns(now.steady.time_since_epoch() - 2s)})
        EXPECT_EQ(host_time(stamp, now, 33ms), now.steady - 33ms) << stamp;
}

TEST(DeviceClock, RemovesTheJitterOfTheTransfer) {
    std::mt19937 rng(3);
    DeviceClock clock;
    for (int n = 0; n < 300; ++n) {
        const Duration device = 5s + n * 33ms;
        const Duration delay = 4ms + Duration(n < 30 ? n % 2 * 1000 : rng() % 20'000);
        const TimePoint host = TimePoint(100s + device + delay);
        const TimePoint captured = clock.captured(device, host);
        EXPECT_LE(captured, host);
        // The shortest delay is 4 ms; the allowance for drift lets it grow in between.
        EXPECT_NEAR(to_ms(captured - TimePoint(100s + device)), 4.0, 1.0) << n;
    }
}

TEST(DeviceClock, FollowsADriftingCrystal) {
    DeviceClock clock;
    TimePoint captured, host;
    for (int n = 0; n < 3000; ++n) {
        const Duration device = n * 33ms;
        host = TimePoint(100s + device + device / 10'000);  // 100 ppm slow
        captured = clock.captured(device + 1us, host);
    }
    EXPECT_NEAR(to_ms(host - captured), 0, 0.1);
}

TEST(DeviceClock, BeginsAnewWhenTheDevicesClockDoes) {
    DeviceClock clock;
    clock.captured(50s, TimePoint(100s));
    EXPECT_EQ(clock.captured(1s, TimePoint(101s)), TimePoint(101s));
    EXPECT_EQ(clock.captured(70s, TimePoint(102s)), TimePoint(102s));
    // The camera's clock has stopped: the estimate is at most half a second early.
    EXPECT_GE(clock.captured(70s, TimePoint(105s)), TimePoint(104500ms));
}

TEST(DeviceClock, WithoutDeviceTimeItIsTheHosts) {
    DeviceClock clock;
    for (const Duration host : {3s, 4s, 5s})
        EXPECT_EQ(clock.captured(Duration(0), TimePoint(host)), TimePoint(host));
}

}  // namespace
}  // namespace theatron::capture
