// SPDX-License-Identifier: Apache-2.0
#include "photon/latency.h"

#include <gtest/gtest.h>

#include <cmath>

namespace theatron::photon {
namespace {

struct Times {
    double delay_ms = 100, film_fps = 240, film_speed = 1, begin_ms = 1000, seconds = 3;
    std::size_t scene = 0;
};

double at_last_refresh(double ms, double hz, double phase_ms) {
    const double period = 1000 / hz;
    return std::floor((ms - phase_ms) / period) * period + phase_ms;
}

constexpr double screen_hz = 60, screen_phase_ms = 3, camera_fps = 29.9, camera_phase_ms = 11;

// The time on the display, `delay_ms` after it was taken.
double shown_at(double now, double delay_ms) {
    return at_last_refresh(at_last_refresh(now, camera_fps, camera_phase_ms) - delay_ms, screen_hz,
                           screen_phase_ms);
}

std::vector<FilmFrame> film(const Times& t) {
    std::vector<FilmFrame> frames;
    for (int i = 0; i < int(t.seconds * t.film_fps); ++i) {
        const double now = t.begin_ms + i * 1000 / t.film_fps;
        FilmFrame frame{i * 1000 / t.film_fps / t.film_speed, {}};
        frame.times[t.scene] =
            StripTime(std::int64_t(at_last_refresh(now, screen_hz, screen_phase_ms)));
        frame.times[1 - t.scene] = StripTime(std::int64_t(shown_at(now, t.delay_ms)));
        frames.push_back(frame);
    }
    return frames;
}

// The mean over what the display shows, of the time since the scene's screen did.
double true_latency_ms(const Times& t) {
    double sum = 0;
    int count = 0;
    const double first = at_last_refresh(t.begin_ms, camera_fps, camera_phase_ms);
    for (double now = first + 0.001; now < t.begin_ms + t.seconds * 1000;
         now += 1000 / camera_fps) {
        sum += now - shown_at(now, t.delay_ms);
        ++count;
    }
    return sum / count;
}

// Film and screen keep their places to each other, so a film's frame tells no more.
constexpr double half_frame_ms = 500.0 / 240;

TEST(Latency, IsThatOfTheDisplay) {
    for (const double delay : {20.0, 75.0, 150.0, 1200.0}) {
        const FilmLatency latency = latency_of(film({.delay_ms = delay}), 60);
        ASSERT_EQ(latency.problem, "");
        EXPECT_NEAR(latency.latency_ms.mean, true_latency_ms({.delay_ms = delay}), half_frame_ms)
            << delay;
        EXPECT_LT(latency.from_ms, latency.latency_ms.mean);
        EXPECT_GT(latency.to_ms, latency.latency_ms.mean);
        EXPECT_EQ(latency.scene, 0u);
        EXPECT_NEAR(latency.frames_per_second, 240, 1);
        // Until the next picture comes, 33 ms later, what is shown grows older.
        EXPECT_NEAR(latency.age_ms.mean, latency.latency_ms.mean + 1000 / 29.9 / 2, 3);
    }
}

TEST(Latency, DoesNotDependOnWhichStripIsNamedFirst) {
    const FilmLatency one = latency_of(film({}), 60), other = latency_of(film({.scene = 1}), 60);
    EXPECT_EQ(one.latency_ms.mean, other.latency_ms.mean);
    EXPECT_EQ(other.scene, 1u);
}

TEST(Latency, OfASlowMotionIsInRealTime) {
    const FilmLatency latency = latency_of(film({.film_speed = 0.125}), 60);
    ASSERT_EQ(latency.problem, "");
    EXPECT_NEAR(latency.speed, 0.125, 0.001);
    EXPECT_NEAR(latency.latency_ms.mean, true_latency_ms({}), half_frame_ms);
}

TEST(Latency, GoesOnWhereTheTimesBeginAgain) {
    const FilmLatency latency = latency_of(film({.begin_ms = strip_wrap_ms - 1500}), 60);
    ASSERT_EQ(latency.problem, "");
    EXPECT_NEAR(latency.latency_ms.mean, true_latency_ms({}), half_frame_ms);
}

TEST(Latency, OfASlowFilmIsKnownByTheScreensRefresh) {
    const Times slow{.film_fps = 29.7, .seconds = 10};
    const FilmLatency latency = latency_of(film(slow), 60);
    const double truth = true_latency_ms(slow);
    ASSERT_EQ(latency.problem, "");
    EXPECT_NEAR(latency.latency_ms.mean, truth, 10);
    EXPECT_LT(latency.from_ms, truth);
    EXPECT_GT(latency.to_ms, truth);
}

TEST(Latency, LeavesOutTimesThatCannotBe) {
    std::vector<FilmFrame> frames = film({});
    frames[100].times[0] = 55'000;
    frames[200].times[1] = 22'222;
    const FilmLatency latency = latency_of(frames, 60);
    ASSERT_EQ(latency.problem, "");
    EXPECT_EQ(latency.left_out, 2);
    EXPECT_NEAR(latency.latency_ms.mean, true_latency_ms({}), half_frame_ms);
    EXPECT_LT(latency.latency_ms.most, 140);
}

TEST(Latency, IsRefusedWithTheReason) {
    const auto problem = [](std::vector<FilmFrame> frames) {
        return latency_of(frames, 60).problem;
    };
    EXPECT_NE(problem({}).find("can be read together in only 0"), std::string::npos);

    EXPECT_NE(problem(film({.seconds = 0.2})).find("too short"), std::string::npos);

    std::vector<FilmFrame> frames = film({});
    for (FilmFrame& frame : frames)
        frame.times[0] = 4000;
    EXPECT_NE(problem(frames).find("stand still"), std::string::npos);

    frames = film({});
    for (FilmFrame& frame : frames)
        frame.times[1] = 900;
    EXPECT_NE(problem(frames).find("changes only 0 times"), std::string::npos);

    frames = film({.seconds = 6});
    for (std::size_t i = frames.size() / 2; i < frames.size(); ++i)
        frames[i].film_ms += 4 * (frames[i].film_ms - frames[frames.size() / 2].film_ms);
    EXPECT_NE(problem(frames).find("speed changes"), std::string::npos);
}

TEST(Latency, SpreadNamesMeanAndQuantiles) {
    std::vector<double> values;
    for (int i = 0; i <= 100; ++i)
        values.push_back((i * 37) % 101);
    const Spread spread = spread_of(values);
    EXPECT_DOUBLE_EQ(spread.mean, 50);
    EXPECT_EQ(spread.median, 50);
    EXPECT_EQ(spread.p5, 5);
    EXPECT_EQ(spread.p95, 95);
    EXPECT_EQ(spread.least, 0);
    EXPECT_EQ(spread.most, 100);
}

}  // namespace
}  // namespace theatron::photon
