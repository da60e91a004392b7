// SPDX-License-Identifier: Apache-2.0
#include "photon_show.h"

#include <algorithm>
#include <cstdio>

#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "photon/strip.h"
#include "render/fill.h"
#include "window/desktop_window_native.h"

namespace theatron::app {
namespace {

// As bright as a room: a camera's exposure follows neither black nor white.
constexpr Rgb strip_ground{128, 128, 128}, strip_white{255, 255, 255}, strip_black{};

// The strip as large as fits, its cells of whole pixels.
void draw_window(photon::StripTime time, Size window) {
    const int cell = std::max(
        std::min(window.width / photon::strip_width, window.height / photon::strip_height), 1);
    const int left = (window.width - cell * photon::strip_width) / 2;
    const int top = (window.height + cell * photon::strip_height) / 2;  // from below
    const auto part = [&](int column, int row, int columns, int rows, Rgb color) {
        render::fill(
            {0, left + column * cell, top - (row + rows) * cell, {columns * cell, rows * cell}},
            color);
    };
    render::fill({0, 0, 0, window}, strip_ground);
    part(0, 0, photon::strip_width, photon::strip_height, strip_white);
    part(1, 1, photon::strip_width - 2, photon::strip_height - 2, strip_black);
    const photon::StripCells cells = photon::cells_of(time);
    for (int row = 0; row < photon::strip_rows; ++row)
        for (int column = 0; column < photon::strip_columns; ++column)
            if (cells[std::size_t(row * photon::strip_columns + column)])
                part(column + 2, row + 2, 1, 1, strip_white);
}

}  // namespace

void run_photon_show(const PhotonShow& wanted) {
    cli::catch_stop_signals();
    window::DesktopWindow window("Theatron photon", wanted.size);
    if (wanted.full_screen)
        window.fill_screen();
    const TimePoint began = steady_now();
    // A driver that does not wait for the screen would draw more than anybody sees.
    TimePoint next = began;
    bool closed = false;
    long pictures = 0;
    while (!closed && !cli::stop_requested() &&
           (wanted.seconds <= 0 || steady_now() - began < seconds_to_duration(wanted.seconds))) {
        const TimePoint now = steady_now();
        if (now < next)
            window.wait(next - now);
        const window::WindowInput input = window.poll();
        closed = input.close ||
                 std::any_of(input.keys.begin(), input.keys.end(),
                             [](const auto& key) { return key.action == window::Action::leave; });
        if (steady_now() < next)
            continue;
        next = steady_now() + window.picture_time() / 2;
        draw_window(photon::strip_time_at(steady_now()), window.pixels());
        window.present();
        ++pictures;
    }
    const double seconds = to_seconds(steady_now() - began);
    cli::begin_end();
    char text[80];
    std::snprintf(text, sizeof text, "%ld pictures, %.1f a second\n", pictures,
                  seconds > 0 ? double(pictures) / seconds : 0);
    output::print(text);
}

}  // namespace theatron::app
