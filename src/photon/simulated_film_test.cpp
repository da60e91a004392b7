// SPDX-License-Identifier: Apache-2.0
// Whole films with known delays: drawn, searched, read, evaluated.
#include "photon/simulated_film.h"

#include <gtest/gtest.h>

#include "photon/film_strips.h"
#include "photon/latency.h"
#include "photon/strip_finder.h"

namespace theatron::photon {
namespace {

FilmStrips strips_of(const SimulatedFilm& film) {
    FilmStrips strips;
    StripFinder finder;
    GreyImage picture;
    for (int i = 0; i < film.frames(); ++i) {
        film.draw(i, picture);
        strips.add(film.film_time_ms(i), picture.size, finder.find(picture.view()));
    }
    return strips;
}

void expect_known(const SimulatedSetup& setup, double most_error_ms) {
    const SimulatedFilm film(setup);
    const FilmStrips::Pair pair = strips_of(film).pair();
    ASSERT_EQ(pair.problem, "");
    const FilmLatency latency = latency_of(pair.frames, 60);
    ASSERT_EQ(latency.problem, "");
    EXPECT_NEAR(latency.latency_ms.mean, film.true_motion_to_photon_ms(), most_error_ms)
        << setup.delay_ms << " ms at " << setup.film_fps;
    EXPECT_EQ(latency.scene, 0u);
    EXPECT_NEAR(latency.frames_per_second * setup.film_speed / setup.film_fps, setup.film_speed,
                0.01);
}

constexpr Size small{256, 144};

TEST(SimulatedFilm, DelaysAreMeasuredAt240FramesASecond) {
    unsigned seed = 1;
    for (const double delay : {20.0, 90.0, 200.0})
        expect_known({.delay_ms = delay, .seconds = 1, .size = small, .seed = seed++}, 4);
}

TEST(SimulatedFilm, DelaysAreMeasuredInASlowMotion) {
    expect_known({.delay_ms = 120, .film_speed = 0.125, .seconds = 1, .size = small, .seed = 4}, 4);
}

TEST(SimulatedFilm, DelaysAreMeasuredAt60FramesASecond) {
    expect_known({.delay_ms = 120, .film_fps = 59.94, .seconds = 3, .size = small, .seed = 5}, 8);
}

TEST(SimulatedFilm, DelaysAreMeasuredAt30FramesASecond) {
    expect_known({.delay_ms = 120, .film_fps = 29.97, .seconds = 8, .size = small, .seed = 6}, 12);
}

TEST(SimulatedFilm, WithoutAStripIsRefused) {
    FilmStrips strips;
    for (int i = 0; i < 50; ++i)
        strips.add(4.2 * i, small, {});
    EXPECT_NE(strips.pair().problem.find("no strip"), std::string::npos);
}

TEST(SimulatedFilm, WithOneStripOrThreeIsRefused) {
    const auto strip_at = [](double x) {
        return StripReading{{{{x, 10}, {x + 60, 10}, {x + 60, 30}, {x, 30}}}, 7, 100};
    };
    FilmStrips one, three;
    for (int i = 0; i < 50; ++i) {
        one.add(4.2 * i, small, std::vector{strip_at(10)});
        three.add(4.2 * i, small, std::vector{strip_at(10), strip_at(90), strip_at(170)});
    }
    EXPECT_NE(one.pair().problem.find("only one strip"), std::string::npos);
    EXPECT_NE(three.pair().problem.find("3 strips"), std::string::npos);
}

TEST(SimulatedFilm, BlurredBeyondReadingIsRefused) {
    const SimulatedFilm film({.blur_px = 6, .seconds = 0.3, .size = small});
    const FilmStrips::Pair pair = strips_of(film).pair();
    EXPECT_TRUE(!pair.problem.empty() || !latency_of(pair.frames, 60).problem.empty());
}

}  // namespace
}  // namespace theatron::photon
