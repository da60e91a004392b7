// SPDX-License-Identifier: Apache-2.0
#include "photon_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/output.h"
#include "cli/progress.h"
#include "cli/stop_signal.h"
#include "files/json_text.h"
#include "photon/film_strips.h"
#include "photon/latency.h"
#include "photon/simulated_film.h"
#include "photon/strip_finder.h"
#include "photon_figures.h"

namespace theatron::app {
namespace {

// A film of a phone, with its usual rate, for as long as it takes to see a hundred pictures or two.
struct FilmRate {
    double per_second, seconds;
    unsigned first_seed;  // the clocks of no two films begin alike
};
constexpr FilmRate film_rates[] = {{239.76, 3, 1}, {59.94, 5, 1001}, {29.97, 10, 2001}};
constexpr double first_delay_ms = 20, last_delay_ms = 200;

struct FilmErrors {
    std::vector<double> ms;  // with their signs
    int in_interval = 0, refused = 0;
};

photon::FilmLatency measured(const photon::SimulatedFilm& film) {
    photon::FilmStrips strips;
    photon::StripFinder finder;
    photon::GreyImage picture;
    for (int i = 0; i < film.frames() && !cli::stop_requested(); ++i) {
        film.draw(i, picture);
        strips.add(film.film_time_ms(i), picture.size, finder.find(picture.view()));
    }
    const photon::FilmStrips::Pair pair = strips.pair();
    photon::FilmLatency latency;
    latency.problem = pair.problem;
    return pair.problem.empty() ? photon::latency_of(pair.frames, 60) : latency;
}

// Delays are spread evenly; blur, noise and slant go from little to much, each at its own pace.
photon::SimulatedSetup setup_of(const FilmRate& rate, int film, int films) {
    const double share = films > 1 ? double(film) / (films - 1) : 0.5;
    photon::SimulatedSetup setup;
    setup.delay_ms = first_delay_ms + share * (last_delay_ms - first_delay_ms);
    setup.film_fps = rate.per_second;
    setup.seconds = rate.seconds;
    setup.blur_px = 0.5 + 0.5 * (film % 4);
    setup.noise = 2 + 3 * (film % 3);
    setup.slant = film % 2;
    setup.size = {480, 270};
    setup.seed = rate.first_seed + unsigned(film);
    return setup;
}

void add_error(const photon::SimulatedFilm& film, FilmErrors& errors) {
    const photon::FilmLatency latency = measured(film);
    if (!latency.problem.empty()) {
        ++errors.refused;
        return;
    }
    const double truth = film.true_motion_to_photon_ms();
    errors.ms.push_back(latency.latency_ms.mean - truth);
    errors.in_interval += latency.from_ms <= truth && truth <= latency.to_ms;
}

nlohmann::json row_json(const FilmRate& rate, const FilmErrors& errors) {
    double mean = 0, most = 0, bias = 0;
    for (const double error : errors.ms) {
        mean += std::abs(error) / double(errors.ms.size());
        bias += error / double(errors.ms.size());
        most = std::max(most, std::abs(error));
    }
    return {{"frames_per_second", rate.per_second},
            {"films", errors.ms.size()},
            {"refused", errors.refused},
            {"mean_error_ms", tenths(mean)},
            {"bias_ms", tenths(bias)},
            {"most_ms", tenths(most)},
            {"in_interval", errors.in_interval}};
}

}  // namespace

void run_photon_check(const PhotonCheck& wanted) {
    cli::catch_stop_signals();
    const auto progress = cli::show_progress();
    nlohmann::json rows = nlohmann::json::array();
    int done = 0;
    for (const FilmRate& rate : film_rates) {
        FilmErrors errors;
        for (int film = 0; film < wanted.films && !cli::stop_requested(); ++film) {
            progress("measuring films",
                     double(done++) / (wanted.films * double(std::size(film_rates))));
            add_error(photon::SimulatedFilm(setup_of(rate, film, wanted.films)), errors);
        }
        rows.push_back(row_json(rate, errors));
    }
    progress("measuring films", 1);
    cli::begin_end();
    if (wanted.json) {
        output::result(files::json_text(rows) + "\n");
        return;
    }
    std::string text = "frames/s  films  refused  mean error ms  bias ms  most ms  in interval\n";
    for (const auto& row : rows) {
        char line[160];
        std::snprintf(line, sizeof line, "%8.2f %6d %8d %14.1f %8.1f %8.1f %12d\n",
                      row["frames_per_second"].get<double>(), row["films"].get<int>(),
                      row["refused"].get<int>(), row["mean_error_ms"].get<double>(),
                      row["bias_ms"].get<double>(), row["most_ms"].get<double>(),
                      row["in_interval"].get<int>());
        text += line;
    }
    output::print(text);
}

}  // namespace theatron::app
