// SPDX-License-Identifier: Apache-2.0
#include "photon/scene_clock.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace theatron::photon {
namespace {

constexpr std::size_t least_sightings = 12;
constexpr double least_length_ms = 300;  // by the strip's clock

double wrapped_difference(double later, double earlier) {
    return std::remainder(later - earlier, double(strip_wrap_ms));
}

// The median speed over a quarter of the film, at most 10 s of it: finer than the strip's steps and
// shorter than its range.
double rough_speed(std::span<const Sighting> sightings) {
    const double length = sightings.back().film_ms - sightings.front().film_ms;
    const double step = std::min(length / 4, 10'000.0);
    std::vector<double> speeds;
    for (std::size_t i = 0, j = 0; i < sightings.size(); ++i) {
        while (j < sightings.size() && sightings[j].film_ms < sightings[i].film_ms + step)
            ++j;
        if (j == sightings.size())
            break;
        speeds.push_back(difference_ms(sightings[j].time, sightings[i].time) /
                         (sightings[j].film_ms - sightings[i].film_ms));
    }
    return median(std::move(speeds));
}

// A sighting on a straight line: film time since the first, strip time since `zero`.
struct Placed {
    double film_ms, strip_ms;
};

// Least squares over those that are within `reach` of the line; moves the line.
void fit(std::vector<Placed>& points, double& offset, double& speed, double reach) {
    std::erase_if(points, [&](const Placed& p) {
        return std::abs(p.strip_ms - offset - speed * p.film_ms) > reach;
    });
    if (points.size() < least_sightings)
        return;
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const Placed& p : points) {
        x += p.film_ms / double(points.size());
        y += p.strip_ms / double(points.size());
    }
    for (const Placed& p : points) {
        xx += (p.film_ms - x) * (p.film_ms - x);
        xy += (p.film_ms - x) * (p.strip_ms - y);
    }
    if (xx <= 0)
        return;
    speed = xy / xx;
    offset = y - speed * x;
}

// The offsets at which no sighting comes before its time began to be seen, or after the next did.
void bound_offset(std::span<const Placed> points, double refresh_ms, SceneClock& clock) {
    std::vector<double> least, most;
    std::vector<double> steps;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (points[i].strip_ms > points[i - 1].strip_ms)
            steps.push_back(points[i].strip_ms - points[i - 1].strip_ms);
    // Half of a refresh is no step of the screen but of the rounding to milliseconds.
    const double step = std::min(percentile(steps, 0.05), refresh_ms);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double offset = points[i].strip_ms - clock.speed * points[i].film_ms;
        least.push_back(offset);
        const double gap = i > 0 ? clock.speed * (points[i].film_ms - points[i - 1].film_ms) : step;
        if (i > 0 && points[i].strip_ms > points[i - 1].strip_ms)
            most.push_back(points[i].strip_ms - clock.speed * points[i - 1].film_ms);
        if (gap >= step)
            most.push_back(offset + step);
    }
    // Single frames have a wrong time in the file.
    clock.least_offset_ms = percentile(std::move(least), 0.97);
    clock.most_offset_ms = percentile(std::move(most), 0.03);
    clock.least_offset_ms += strip_rounding_ms;
    clock.most_offset_ms += strip_rounding_ms;
    clock.offset_ms = (clock.least_offset_ms + clock.most_offset_ms) / 2;
    if (clock.least_offset_ms > clock.most_offset_ms)
        std::swap(clock.least_offset_ms, clock.most_offset_ms);
}

}  // namespace

double SceneClock::unwrapped(StripTime time, double near_ms) const {
    return near_ms + wrapped_difference(double(difference_ms(time, zero)), near_ms);
}

SceneClock scene_clock_of(std::span<const Sighting> sightings, double refresh_hz) {
    SceneClock clock;
    if (sightings.size() < least_sightings) {
        clock.problem = "the strip on the scene's screen can be read in only " +
                        std::to_string(sightings.size()) +
                        " frames; film it sharper, larger, or for longer";
        return clock;
    }
    clock.zero = sightings.front().time;
    clock.film_zero_ms = sightings.front().film_ms;
    double speed = rough_speed(sightings), offset = 0;
    if (!(speed > 0)) {
        clock.problem = "its strips stand still: the time on the scene's screen does not go on";
        return clock;
    }
    std::vector<Placed> points;
    std::vector<double> residuals;
    for (const Sighting& sighting : sightings) {
        const double film_ms = sighting.film_ms - clock.film_zero_ms;
        const double expected = speed * film_ms;
        points.push_back({film_ms, clock.unwrapped(sighting.time, expected)});
        residuals.push_back(points.back().strip_ms - expected);
    }
    const double length_ms = speed * points.back().film_ms;
    if (length_ms < least_length_ms) {
        clock.problem = "it is too short: film at least a second";
        return clock;
    }
    offset = median(residuals);
    const double refresh_ms = 1000 / refresh_hz;
    const double tight = 4 * refresh_ms + 20;
    fit(points, offset, speed, tight + 0.05 * length_ms);
    fit(points, offset, speed, tight + 0.01 * length_ms);
    fit(points, offset, speed, tight);
    clock.left_out = int(sightings.size() - points.size());
    if (points.size() < least_sightings || points.size() * 5 < sightings.size() * 4) {
        clock.problem =
            "its speed changes, or frames are missing: film all of it at one speed, and "
            "cut nothing";
        return clock;
    }
    clock.speed = speed;
    bound_offset(points, refresh_ms, clock);
    return clock;
}

}  // namespace theatron::photon
