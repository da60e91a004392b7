// SPDX-License-Identifier: Apache-2.0
#include "photon/latency.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/statistics.h"
#include "photon/scene_clock.h"

namespace theatron::photon {
namespace {

constexpr std::size_t least_changes = 8;

// The display's strip in a frame, in strip time.
struct Shown {
    double film_ms, clock_ms, time_ms;
};

// When the display began to show a time: after one frame, before or at the next.
struct Begin {
    double after_ms, until_ms, time_ms;
};

std::vector<Sighting> sightings_of(std::span<const FilmFrame> frames, std::size_t strip) {
    std::vector<Sighting> sightings;
    for (const FilmFrame& frame : frames)
        if (frame.times[strip])
            sightings.push_back({frame.film_ms, *frame.times[strip]});
    return sightings;
}

double frame_period_ms(std::span<const FilmFrame> frames) {
    std::vector<double> periods;
    for (std::size_t i = 1; i < frames.size(); ++i)
        periods.push_back(frames[i].film_ms - frames[i - 1].film_ms);
    return median(std::move(periods));
}

// All readings of the display, but for those that are far from all others: mixtures whose check
// bits fit by chance.
std::vector<Shown> shown_in(std::span<const FilmFrame> frames, std::size_t display,
                            const SceneClock& clock, double usual_age_ms, int& left_out) {
    std::vector<Shown> shown;
    std::vector<double> ages;
    for (const FilmFrame& frame : frames)
        if (frame.times[display]) {
            const double now = clock.at(frame.film_ms);
            const double time = clock.unwrapped(*frame.times[display], now - usual_age_ms);
            shown.push_back({frame.film_ms, now, time + strip_rounding_ms});
            ages.push_back(now - shown.back().time_ms);
        }
    const double middle = median(ages);
    const double reach = 10 * (percentile(ages, 0.9) - percentile(ages, 0.1)) + 200;
    const std::size_t all = shown.size();
    std::erase_if(shown, [&](const Shown& one) {
        return std::abs(one.clock_ms - one.time_ms - middle) > reach;
    });
    left_out += int(all - shown.size());
    return shown;
}

std::vector<Begin> begins_of(std::span<const Shown> shown, double period_ms) {
    constexpr double longest_gap = 4;  // frames; beyond that the moment is too uncertain
    std::vector<Begin> begins;
    for (std::size_t i = 1; i < shown.size(); ++i) {
        const Shown &before = shown[i - 1], &now = shown[i];
        if (now.time_ms > before.time_ms + 0.5 &&
            now.clock_ms - before.clock_ms < longest_gap * period_ms)
            begins.push_back({before.clock_ms, now.clock_ms, now.time_ms});
    }
    return begins;
}

// Resamples the changes (bootstrap), each with another moment within its interval, and the clock's
// offset within its own.
void bound_mean(std::span<const Begin> begins, const SceneClock& clock, FilmLatency& result) {
    constexpr int rounds = 1000;
    std::mt19937 random(1);
    const auto share = [&] { return double(random()) / double(std::mt19937::max()); };
    std::vector<double> means;
    for (int round = 0; round < rounds; ++round) {
        const double offset =
            clock.least_offset_ms + share() * (clock.most_offset_ms - clock.least_offset_ms);
        // The changes keep their place between two frames for a while, as two clocks drift slowly.
        const double place = share();
        double sum = 0;
        for (std::size_t i = 0; i < begins.size(); ++i) {
            const Begin& begin = begins[random() % begins.size()];
            sum += begin.after_ms + place * (begin.until_ms - begin.after_ms) - begin.time_ms;
        }
        means.push_back(sum / double(begins.size()) + offset - clock.offset_ms);
    }
    result.from_ms = percentile(means, 0.025);
    result.to_ms = percentile(means, 0.975);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    Spread spread;
    if (values.empty())
        return spread;
    for (const double value : values)
        spread.mean += value / double(values.size());
    spread.median = median(values);
    spread.p5 = percentile(values, 0.05);
    spread.p95 = percentile(values, 0.95);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    spread.least = *least;
    spread.most = *most;
    return spread;
}

FilmLatency latency_of(std::span<const FilmFrame> frames, double refresh_hz) {
    FilmLatency result;
    result.frames = int(frames.size());
    std::vector<double> ahead;
    for (const FilmFrame& frame : frames)
        if (frame.times[0] && frame.times[1])
            ahead.push_back(difference_ms(*frame.times[0], *frame.times[1]));
    if (ahead.size() < least_changes) {
        result.problem = "both strips can be read together in only " +
                         std::to_string(ahead.size()) + " of " + std::to_string(frames.size()) +
                         " frames; film them sharper, larger, and with a shorter exposure";
        return result;
    }
    const double usual = median(ahead);
    result.scene = usual >= 0 ? 0 : 1;
    const std::vector<Sighting> scene = sightings_of(frames, result.scene);
    const SceneClock clock = scene_clock_of(scene, refresh_hz);
    if (!clock.problem.empty()) {
        result.problem = clock.problem;
        return result;
    }
    result.left_out = clock.left_out;
    const std::vector<Shown> shown =
        shown_in(frames, 1 - result.scene, clock, std::abs(usual), result.left_out);
    const double period_ms = clock.speed * frame_period_ms(frames);
    const std::vector<Begin> begins = begins_of(shown, period_ms);
    if (begins.size() < least_changes) {
        result.problem = "the display's strip changes only " + std::to_string(begins.size()) +
                         " times where it can be read; film for longer, or see that the picture "
                         "on the display is live";
        return result;
    }
    result.speed = clock.speed;
    result.frames_per_second = 1000 / period_ms;
    result.scene_read = int(scene.size());
    result.display_read = int(shown.size());
    std::vector<double> latencies, ages;
    const double start = clock.at(frames.front().film_ms);
    for (const Begin& begin : begins) {
        const double middle = (begin.after_ms + begin.until_ms) / 2;
        result.changes.push_back({middle - start, middle - begin.time_ms});
        latencies.push_back(middle - begin.time_ms);
    }
    for (const Shown& one : shown)
        ages.push_back(one.clock_ms - one.time_ms);
    result.latency_ms = spread_of(std::move(latencies));
    result.age_ms = spread_of(std::move(ages));
    bound_mean(begins, clock, result);
    return result;
}

}  // namespace theatron::photon
