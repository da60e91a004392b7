// SPDX-License-Identifier: Apache-2.0
#include "photon_film.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "capture/readable_file.h"
#include "capture/video_recording.h"
#include "export/export_places.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "photon/film_strips.h"
#include "photon/latency.h"
#include "photon/latency_plot.h"
#include "photon/strip_finder.h"
#include "photon_figures.h"

namespace theatron::app {
namespace {

class FilmProgress {
public:
    void tell(int frames, Duration film) {
        const TimePoint now = steady_now();
        if (now < next_)
            return;
        next_ = now + (on_terminal_ ? Duration(500ms) : Duration(5s));
        char text[100];
        std::snprintf(text, sizeof text, "reading the film: %d frames, %.1f s", frames,
                      to_seconds(film));
        if (on_terminal_)
            output::status_line(text, output::Stream::error);
        else
            output::print(std::string(text) + "\n", output::Stream::error);
    }
    ~FilmProgress() {
        if (on_terminal_)
            output::end_status_line();
    }

private:
    const bool on_terminal_ = isatty(STDERR_FILENO);
    TimePoint next_ = steady_now() + 2s;
};

photon::FilmStrips strips_in(capture::VideoRecording& film) {
    photon::FilmStrips strips;
    photon::StripFinder finder;
    photon::GreyImage grey;
    Frame frame;
    FilmProgress progress;
    while (const std::optional<Duration> time = film.offset()) {
        if (!film.read(frame))
            continue;
        photon::grey_of(frame.color.pixels.view(), grey);
        strips.add(to_ms(*time), grey.size, finder.find(grey.view()));
        progress.tell(strips.frames(), *time);
    }
    return strips;
}

// Rows are exposed one after the other, all within a frame's time.
double row_shift_ms(const photon::FilmLatency& latency, const photon::FilmStrips::Pair& pair) {
    return std::abs(pair.places[0].y_share - pair.places[1].y_share) * 1000 /
           latency.frames_per_second;
}

nlohmann::json film_json(const PhotonFilm& wanted, const photon::FilmLatency& latency,
                         const photon::FilmStrips::Pair& pair) {
    nlohmann::json changes = nlohmann::json::array();
    for (const photon::SeenChange& change : latency.changes)
        changes.push_back({tenths(change.at_ms), tenths(change.latency_ms)});
    const auto place = [&](std::size_t i) {
        const photon::FilmStrips::Place& strip = pair.places[i];
        return nlohmann::json{{"x", std::round(strip.x_share * 1000) / 1000},
                              {"y", std::round(strip.y_share * 1000) / 1000},
                              {"contrast", std::round(strip.contrast)}};
    };
    return {{"film", wanted.film},
            {"motion_to_photon_ms", spread_json(latency.latency_ms)},
            {"mean_interval_95_ms", {tenths(latency.from_ms), tenths(latency.to_ms)}},
            {"age_ms", spread_json(latency.age_ms)},
            {"changes", latency.changes.size()},
            {"frames", latency.frames},
            {"frames_per_second", tenths(latency.frames_per_second)},
            {"film_speed", std::round(latency.speed * 10'000) / 10'000},
            {"scene_read", latency.scene_read},
            {"display_read", latency.display_read},
            {"left_out", latency.left_out},
            {"row_shift_ms", tenths(row_shift_ms(latency, pair))},
            {"scene", place(latency.scene)},
            {"display", place(1 - latency.scene)},
            {"latencies", changes}};
}

std::string film_text(const photon::FilmLatency& latency, const photon::FilmStrips::Pair& pair) {
    char text[900];
    const photon::Spread &motion = latency.latency_ms, &age = latency.age_ms;
    std::snprintf(text, sizeof text,
                  "motion to photon  mean %.1f ms (95 %%: %.1f to %.1f), median %.1f, 5 %% below "
                  "%.1f, 5 %% above %.1f; %zu changes\n"
                  "age on display    mean %.1f ms, 5 %% above %.1f, most %.1f\n"
                  "film              %d frames, %.1f a second%s; scene read in %d, display in %d, "
                  "left out %d\n",
                  motion.mean, latency.from_ms, latency.to_ms, motion.median, motion.p5, motion.p95,
                  latency.changes.size(), age.mean, age.p95, age.most, latency.frames,
                  latency.frames_per_second,
                  std::abs(latency.speed - 1) > 0.02 ? " (slow or fast motion)" : "",
                  latency.scene_read, latency.display_read, latency.left_out);
    std::string all = text;
    constexpr double told_shift_ms = 1;
    if (const double shift = row_shift_ms(latency, pair); shift > told_shift_ms) {
        std::snprintf(
            text, sizeof text,
            "The strips are at different heights of the picture, whose rows are taken one "
            "after the other: up to %.1f ms of error.\n",
            shift);
        all += text;
    }
    return all;
}

void check_film_plot(const PhotonFilm& wanted) {
    if (wanted.plot.empty())
        return;
    if (std::filesystem::path(wanted.plot).extension() != ".svg")
        throw Error("The plot '" + wanted.plot + "' does not end in .svg.");
    exporting::require_free(wanted.plot, wanted.overwrite);
    files::require_writable(wanted.plot);
}

}  // namespace

void run_photon_film(const PhotonFilm& wanted) {
    check_film_plot(wanted);
    capture::VideoRecording film(wanted.film);
    const photon::FilmStrips strips = strips_in(film);
    const auto refuse = [&](const std::string& problem) {
        throw Error("The film " + capture::quoted(wanted.film) + " cannot be used: " + problem +
                    ".");
    };
    const photon::FilmStrips::Pair pair = strips.pair();
    if (!pair.problem.empty())
        refuse(pair.problem);
    const photon::FilmLatency latency = photon::latency_of(pair.frames, wanted.refresh_hz);
    if (!latency.problem.empty())
        refuse(latency.problem);
    if (!wanted.plot.empty()) {
        const std::string svg =
            photon::latency_svg(latency, std::filesystem::path(wanted.film).filename().string());
        files::write_file(wanted.plot, std::as_bytes(std::span(svg)));
    }
    if (wanted.json)
        output::result(files::json_text(film_json(wanted, latency, pair)) + "\n");
    else
        output::print(film_text(latency, pair));
    if (const std::uint64_t lost = film.lost_pictures(); lost > 0)
        output::print("theatron: " + std::to_string(lost) +
                          " pictures of the film are damaged and were left out.\n",
                      output::Stream::error);
}

}  // namespace theatron::app
