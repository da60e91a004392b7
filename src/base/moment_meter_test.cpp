// SPDX-License-Identifier: Apache-2.0
#include "base/moment_meter.h"

#include <gtest/gtest.h>

#include <limits>

namespace theatron {
namespace {

constexpr TimePoint zero{std::chrono::hours(1)};
constexpr Duration period = 33'333us;
constexpr ParticipantId host{}, other{7};

TimePoint moment_of(int i) {
    return zero + i * period;
}

// `moments` of two cameras; the second one exposes `later`, and lacks each picture whose number
// `lacks` divides (0: none).
MomentFigures of_two(int moments, Duration later, int lacks) {
    MomentMeter meter;
    for (int i = 1; i <= moments; ++i) {
        meter.add(host, CameraId(0), moment_of(i), moment_of(i));
        if (lacks == 0 || i % lacks != 0)
            meter.add(host, CameraId(1), moment_of(i), moment_of(i) + later);
    }
    return meter.figures();
}

TEST(MomentMeter, OneCameraHasNobodyToBePairedWith) {
    MomentMeter meter;
    for (int i = 0; i < 100; ++i)
        meter.add(host, CameraId(0), moment_of(i), moment_of(i));
    EXPECT_FALSE(meter.figures().any());
}

TEST(MomentMeter, TellsTheMiddleAndTheLargestSkew) {
    const MomentFigures in_step = of_two(100, 0us, 0);
    EXPECT_EQ(in_step.whole, 100 - MomentMeter::open_moments);
    EXPECT_EQ(in_step.skew_p50_ms, 0);
    EXPECT_EQ(in_step.skew_max_ms, 0);
    EXPECT_EQ(in_step.unpaired, 0u);
    EXPECT_EQ(of_two(100, 15ms, 0).skew_p50_ms, 15);

    // One sample far from the others, as at the end of a picture's loop, moves the largest alone.
    MomentMeter meter;
    for (int i = 0; i < 101; ++i) {
        meter.add(host, CameraId(0), moment_of(i), moment_of(i));
        meter.add(host, CameraId(1), moment_of(i), moment_of(i) + (i == 50 ? 215ms : 15ms));
    }
    EXPECT_EQ(meter.figures().skew_p50_ms, 15);
    EXPECT_EQ(meter.figures().skew_max_ms, 215);
    meter.reset();
    EXPECT_FALSE(meter.figures().any());
}

TEST(MomentMeter, CountsThePicturesWhosePartnerDidNotCome) {
    const MomentFigures gaps = of_two(16 + 70, 0us, 7);
    EXPECT_EQ(gaps.unpaired, 10u);
    EXPECT_EQ(gaps.whole, 60u);
    // A camera with half the rate leaves every second picture of the other one alone.
    EXPECT_EQ(of_two(16 + 70, 0us, 2).unpaired, 35u);
}

TEST(MomentMeter, ACameraThatComesLaterOrStopsIsNotMissed) {
    MomentMeter meter;
    for (int i = 0; i < 200; ++i) {
        meter.add(host, CameraId(0), moment_of(i), moment_of(i));
        if (i >= 60 && i < 120)
            meter.add(host, CameraId(1), moment_of(i), moment_of(i));
    }
    EXPECT_EQ(meter.figures().unpaired, 0u);
    EXPECT_EQ(meter.figures().whole, 60u);
}

TEST(MomentMeter, FurtherStreamsAndSettingsOfACameraCountOnce) {
    MomentMeter meter;
    for (int i = 0; i < 50; ++i)
        for (const int camera : {0, 0, 1, 1, 1})
            meter.add(host, CameraId(camera), moment_of(i), moment_of(i));
    EXPECT_EQ(meter.figures().whole, 50 - MomentMeter::open_moments);
    EXPECT_EQ(meter.figures().unpaired, 0u);
}

TEST(MomentMeter, CamerasOfTwoPublishersHaveNoMomentsInCommon) {
    MomentMeter meter;
    for (int i = 0; i < 100; ++i) {
        meter.add(host, CameraId(0), moment_of(i), moment_of(i));
        meter.add(other, CameraId(1), moment_of(i) + 4ms, moment_of(i) + 4ms);
    }
    EXPECT_FALSE(meter.figures().any());
}

TEST(MomentMeter, PicturesMayComeInAnyOrderWithinTheOpenMoments) {
    MomentMeter meter;
    for (int i = 0; i < 100; ++i) {
        meter.add(host, CameraId(0), moment_of(i), moment_of(i));
        if (i >= 10)
            meter.add(host, CameraId(1), moment_of(i - 10), moment_of(i - 10) + 3ms);
    }
    EXPECT_EQ(meter.figures().unpaired, 0u);
    EXPECT_EQ(meter.figures().skew_max_ms, 3);
}

TEST(MomentMeter, ARecordingThatIsPlayedAgainBeginsAnew) {
    MomentMeter meter;
    for (int round = 0; round < 2; ++round)
        for (int i = 0; i < 100; ++i)
            for (const int camera : {0, 1})
                meter.add(host, CameraId(camera), moment_of(i), moment_of(i));
    EXPECT_EQ(meter.figures().whole, 2 * (100 - MomentMeter::open_moments));
    EXPECT_EQ(meter.figures().unpaired, 0u);
}

TEST(MomentMeter, ImpossibleTimesAreLeftOut) {
    MomentMeter meter;
    for (int i = 0; i < 100; ++i)
        for (const std::int64_t us : {std::numeric_limits<std::int64_t>::min(), std::int64_t(i),
                                      std::numeric_limits<std::int64_t>::max()}) {
            meter.add(host, CameraId(0), from_us(us), from_us(i));
            meter.add(host, CameraId(1), from_us(i), from_us(us));
        }
    EXPECT_LE(meter.figures().skew_max_ms, 1);
}

TEST(MomentMeter, KeepsNoMoreForManyPublishers) {
    MomentMeter meter;
    for (int publisher = 0; publisher < 1000; ++publisher)
        for (int i = 0; i < 20; ++i)
            for (const int camera : {0, 1})
                meter.add(ParticipantId(publisher), CameraId(camera), moment_of(20 * publisher + i),
                          moment_of(20 * publisher + i));
    EXPECT_EQ(meter.figures().whole, 1000 * (20 - MomentMeter::open_moments));
}

}  // namespace
}  // namespace theatron
