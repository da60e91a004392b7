// SPDX-License-Identifier: Apache-2.0
#include "photon/simulated_film.h"

#include <algorithm>
#include <cmath>

#include "photon/plane_map.h"

namespace theatron::photon {
namespace {

// The times begin here, so that none is below zero.
constexpr double begin_ms = 60'000;
constexpr double room_brightness = 70, black = 22, white = 205;

StripTime strip_time(double ms) {
    return StripTime(std::int64_t(ms) & (strip_wrap_ms - 1));
}

void blur(GreyImage& image, double deviation) {
    if (deviation <= 0)
        return;
    const auto [width, height] = image.size;
    const int reach = std::max(int(std::ceil(3 * deviation)), 1);
    std::vector<double> weights;
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) {
        weights.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
        sum += weights.back();
    }
    std::vector<float> across(image.pixels.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double value = 0;
            for (int i = -reach; i <= reach; ++i)
                value += weights[std::size_t(i + reach)] *
                         image.view().row(y)[std::clamp(x + i, 0, width - 1)];
            across[std::size_t(y * width + x)] = float(value / sum);
        }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double value = 0;
            for (int i = -reach; i <= reach; ++i)
                value += weights[std::size_t(i + reach)] *
                         across[std::size_t(std::clamp(y + i, 0, height - 1) * width + x)];
            image.view().row(y)[x] = std::uint8_t(value / sum + 0.5);
        }
}

void add_noise(GreyImage& image, double deviation, unsigned seed) {
    if (deviation <= 0)
        return;
    std::minstd_rand random(seed);
    std::normal_distribution<float> noise(0, float(deviation));
    for (std::uint8_t& pixel : image.pixels)
        pixel = std::uint8_t(std::clamp(float(pixel) + noise(random) + 0.5f, 0.f, 255.f));
}

// Where the outer edge of the strip's border is seen.
Quad place_of(bool is_display, Size size, double slant) {
    const double w = size.width, h = size.height, s = slant;
    if (is_display)
        return {{{0.54 * w, (0.40 - 0.05 * s) * h},
                 {(0.97 - 0.03 * s) * w, (0.40 + 0.02 * s) * h},
                 {(0.97 - 0.02 * s) * w, 0.70 * h},
                 {(0.54 - 0.01 * s) * w, (0.70 + 0.02 * s) * h}}};
    return {{{0.03 * w, (0.38 + 0.03 * s) * h},
             {(0.47 - 0.02 * s) * w, (0.38 - 0.02 * s) * h},
             {(0.47 - 0.01 * s) * w, (0.70 + 0.03 * s) * h},
             {(0.03 + 0.02 * s) * w, 0.70 * h}}};
}

}  // namespace

long SimulatedFilm::Beat::number_at(double ms) const {
    return long(std::floor((ms - first_ms) / period_ms));
}

SimulatedFilm::SimulatedFilm(const SimulatedSetup& setup) : setup_(setup) {
    std::mt19937 random(setup.seed);
    const auto beat = [&](double per_second) {
        const double period = 1000 / per_second;
        const double share = double(random() % 4096) / 4096;
        return Beat{begin_ms - 2000 + share * period, period};
    };
    screen_ = beat(setup.screen_hz);
    display_ = beat(setup.display_hz);
    camera_ = beat(setup.camera_fps);
    film_ = beat(setup.film_fps);
    film_.first_ms += 2000;
}

double SimulatedFilm::film_time_ms(int frame) const {
    return frame * film_.period_ms / setup_.film_speed;
}

double SimulatedFilm::frame_begin_ms(int frame) const {
    return film_.time_of(frame);
}

double SimulatedFilm::taken_ms(long picture) const {
    return camera_.time_of(picture) + setup_.camera_exposure_ms / 2;
}

double SimulatedFilm::shown_ms(long picture) const {
    const double due = taken_ms(picture) + setup_.delay_ms;
    return display_.time_of(display_.number_at(due) + 1);
}

long SimulatedFilm::picture_shown_at(double ms) const {
    long picture = camera_.number_at(ms);
    while (shown_ms(picture) > ms)
        --picture;
    return picture;
}

SimulatedFilm::Mixture SimulatedFilm::scene_between(double from_ms, double to_ms) const {
    Mixture mixture;
    for (long n = screen_.number_at(from_ms); screen_.time_of(n) < to_ms; ++n) {
        const double begin = std::max(from_ms, screen_.time_of(n));
        const double end = std::min(to_ms, screen_.time_of(n + 1));
        mixture.parts.push_back(
            {strip_time(screen_.time_of(n)), (end - begin) / (to_ms - from_ms)});
    }
    return mixture;
}

SimulatedFilm::Mixture SimulatedFilm::display_between(double from_ms, double to_ms) const {
    Mixture mixture;
    for (long n = display_.number_at(from_ms); display_.time_of(n) < to_ms; ++n) {
        const double begin = std::max(from_ms, display_.time_of(n));
        const double end = std::min(to_ms, display_.time_of(n + 1));
        const double taken = taken_ms(picture_shown_at(display_.time_of(n)));
        const double half = setup_.camera_exposure_ms / 2;
        for (const auto& part : scene_between(taken - half, taken + half).parts)
            mixture.parts.push_back({part.time, part.share * (end - begin) / (to_ms - from_ms)});
    }
    return mixture;
}

void SimulatedFilm::draw_one(int frame, bool is_display, GreyImage& out) const {
    const Quad place = place_of(is_display, out.size, setup_.slant);
    const PlaneMap map(place, {0, 0}, {strip_width, strip_height});
    const auto [low, high] =
        std::minmax_element(place.begin(), place.end(), [](Point a, Point b) { return a.y < b.y; });
    const int left = std::max(int(std::min(place[0].x, place[3].x)), 0);
    const int right = std::min(int(std::max(place[1].x, place[2].x)) + 1, out.size.width);
    const double exposure = std::min(setup_.exposure_share * film_.period_ms, 8.0);
    constexpr int shares = 2;  // on each side of a pixel
    for (int y = int(low->y); y < int(high->y) + 1; ++y) {
        const double begin =
            frame_begin_ms(frame) + setup_.readout_share * film_.period_ms * y / out.size.height;
        const Mixture mixture = is_display ? display_between(begin, begin + exposure)
                                           : scene_between(begin, begin + exposure);
        std::vector<StripCells> cells;
        for (const auto& part : mixture.parts)
            cells.push_back(cells_of(part.time));
        for (int x = left; x < right; ++x) {
            double sum = 0;
            for (int i = 0; i < shares * shares; ++i) {
                const Point at = map.to_plane(
                    {x + (i % shares + 0.5) / shares, y + (i / shares + 0.5) / shares});
                if (!(at.x >= 0 && at.x < strip_width && at.y >= 0 && at.y < strip_height)) {
                    sum += room_brightness;
                    continue;
                }
                for (std::size_t part = 0; part < cells.size(); ++part)
                    sum += mixture.parts[part].share *
                           (is_white(cells[part], at.x, at.y) ? white : black);
            }
            std::uint8_t& pixel = out.view().row(y)[x];
            const double mean = sum / (shares * shares);
            if (mean != room_brightness)
                pixel = std::uint8_t(mean + 0.5);
        }
    }
}

void SimulatedFilm::draw(int frame, GreyImage& out) const {
    out.resize(setup_.size);
    std::fill(out.pixels.begin(), out.pixels.end(), std::uint8_t(room_brightness));
    draw_one(frame, false, out);
    draw_one(frame, true, out);
    blur(out, setup_.blur_px);
    add_noise(out, setup_.noise, setup_.seed * 7919 + unsigned(frame));
}

double SimulatedFilm::true_motion_to_photon_ms() const {
    double sum = 0;
    int count = 0;
    const double end = frame_begin_ms(frames());
    for (long picture = picture_shown_at(frame_begin_ms(0)) + 1; shown_ms(picture) < end;
         ++picture) {
        const double changed = screen_.time_of(screen_.number_at(taken_ms(picture)));
        sum += shown_ms(picture) - changed;
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

}  // namespace theatron::photon
