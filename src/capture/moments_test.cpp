// SPDX-License-Identifier: Apache-2.0
#include "capture/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace theatron::capture {
namespace {

struct Sensor {
    double fps;
    double phase_us;
    double jitter_us;
    std::int64_t next = 0;

    double due() const { return 1e6 + phase_us + double(next) * 1e6 / fps; }
};

struct Matched {
    int frames = 0, passed_over = 0, left_out = 0;
    double worst_offset_us = 0;
};

// Runs the sensors together and counts for each what happened to its frames.
std::vector<Matched> run(std::vector<Sensor> sensors, double seconds) {
    Moments moments(30);
    std::mt19937 rng(1);
    std::normal_distribution<double> noise;
    std::vector<Matched> result(sensors.size());
    std::vector<std::int64_t> last(sensors.size(), -1);
    std::map<std::int64_t, TimePoint> times;
    while (true) {
        std::size_t first = 0;
        for (std::size_t i = 1; i < sensors.size(); ++i)
            if (sensors[i].due() < sensors[first].due())
                first = i;
        Sensor& s = sensors[first];
        if (s.due() > seconds * 1e6)
            return result;
        const TimePoint captured = from_us(std::llround(s.due() + s.jitter_us * noise(rng)));
        ++s.next;
        const Moments::Tag tag = moments.tag(CameraId(first), captured);
        Matched& m = result[first];
        ++m.frames;
        m.worst_offset_us = std::max(m.worst_offset_us, std::abs(double(tag.offset.count())));
        if (tag.pass_over) {
            ++m.passed_over;
            continue;
        }
        EXPECT_GT(tag.index, last[first]);
        if (last[first] >= 0)
            m.left_out += int(tag.index - last[first] - 1);
        last[first] = tag.index;
        const auto [told, is_new] = times.emplace(tag.index, tag.moment);
        EXPECT_EQ(told->second, tag.moment) << "cameras are told different times of a moment";
    }
}

TEST(Moments, SynchronisedCamerasShareEveryMomentWhateverTheirPhase) {
    for (const double phase : {0.0, 8'000.0, 16'666.0, 25'000.0}) {
        const auto result =
            run({{30, phase, 100}, {30, phase + 160, 100}, {30, phase + 320, 100}}, 60);
        for (const Matched& m : result) {
            EXPECT_EQ(m.passed_over + m.left_out, 0) << phase;
            EXPECT_LT(m.worst_offset_us, 1500);
        }
    }
}

TEST(Moments, FreeRunningCamerasStayMatchedAndSkipAFrameNowAndThen) {
    const double seconds = 600;
    const auto result = run({{30.03, 0, 50}, {30.14, 9'000, 50}, {29.9, 14'000, 50}}, seconds);
    for (const Matched& m : result)
        EXPECT_LE(m.worst_offset_us, 1e6 / 30 * 0.56);
    EXPECT_EQ(result[0].passed_over + result[0].left_out, 0);
    // Sensor 1 has 0.11 frames a second too many, sensor 2 has 0.13 too few.
    EXPECT_NEAR(result[1].passed_over, seconds * 0.11, 3);
    EXPECT_LE(result[1].left_out, 1);
    EXPECT_NEAR(result[2].left_out, seconds * 0.13, 3);
    EXPECT_LE(result[2].passed_over, 1);
}

TEST(Moments, JitterBetweenTwoMomentsThrowsNoFramesAway) {
    // Half a frame apart permanently, with a millisecond of jitter.
    const auto result = run({{30, 0, 20}, {30, 16'700, 400}}, 300);
    EXPECT_LE(result[1].passed_over + result[1].left_out, 5);
}

TEST(Moments, ASlowCameraTakesEverySecondMoment) {
    const auto result = run({{30, 0, 50}, {15, 3'000, 50}}, 20);
    EXPECT_EQ(result[1].passed_over, 0);
    EXPECT_NEAR(result[1].left_out, result[1].frames, 2);
}

TEST(Moments, AnotherCameraLeadsWhenTheLeaderIsGone) {
    Moments moments(30);
    for (int i = 0; i < 30; ++i) {
        moments.tag(CameraId{0}, from_us(1'000'000 + i * 33'333));
        moments.tag(CameraId{1}, from_us(1'005'000 + i * 33'333));
    }
    // Camera 0 is silent. Camera 1 drifts on its own, long enough to exceed half a frame.
    std::int64_t last = 29;
    for (int i = 30; i < 3000; ++i) {
        const auto tag = moments.tag(CameraId{1}, from_us(1'005'000 + i * 33'200));
        EXPECT_FALSE(tag.pass_over && i > 400);
        EXPECT_LE(std::abs(double(tag.offset.count())), 33'333 * 0.56);
        last = std::max(last, tag.index);
    }
    EXPECT_NEAR(double(last), 2999, 15);
}

}  // namespace
}  // namespace theatron::capture
