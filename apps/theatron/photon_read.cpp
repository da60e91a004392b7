// SPDX-License-Identifier: Apache-2.0
#include "photon_read.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/output.h"
#include "base/steady_clock.h"
#include "cli/stop_signal.h"
#include "files/file_bytes.h"
#include "files/json_text.h"
#include "files/png_file.h"
#include "join_pictures.h"
#include "photon/latency.h"
#include "photon/stages.h"
#include "photon/strip_finder.h"
#include "photon_figures.h"
#include "photon_pictures.h"

namespace theatron::app {
namespace {

bool is_picture_file(const std::string& source) {
    return source.ends_with(".png") || source.ends_with(".PNG");
}

bool is_session_link(const std::string& source) {
    return source.starts_with("https://") || source.starts_with("@");
}

// The times in picture files, which have no age: nobody knows when they were seen.
void read_files(const PhotonRead& wanted) {
    nlohmann::json files = nlohmann::json::array();
    bool found = false;
    for (const std::string& file : wanted.sources) {
        photon::GreyImage grey;
        photon::grey_of(files::read_color_png(file).view(), grey);
        nlohmann::json strips = nlohmann::json::array();
        for (const photon::StripReading& strip : photon::find_strips(grey.view())) {
            found = true;
            strips.push_back({{"time_ms", strip.time ? nlohmann::json(*strip.time) : nullptr},
                              {"x", tenths(strip.frame[0].x)},
                              {"y", tenths(strip.frame[0].y)},
                              {"contrast", std::round(strip.contrast)}});
            if (!wanted.json)
                output::print(file + ": " +
                              (strip.time ? std::to_string(*strip.time) + " ms"
                                          : "a strip whose time cannot be read") +
                              "\n");
        }
        files.push_back({{"file", file}, {"strips", strips}});
    }
    if (wanted.json)
        output::result(files::json_text(files) + "\n");
    if (!found)
        throw Error("There is no strip in " +
                    std::string(wanted.sources.size() == 1 ? "this picture" : "these pictures") +
                    "; it must be at least 48 pixels wide, with its white border.");
}

// The ages that were read so far, and the pictures without one.
struct StripAges {
    std::vector<double> ms;
    int pictures = 0, unread = 0, without = 0, several = 0;

    void add(const ColorImage& picture, TimePoint now) {
        ++pictures;
        photon::grey_of(picture.view(), grey_);
        const auto strips = finder_.find(grey_.view());
        if (strips.empty())
            ++without;
        else if (strips.size() > 1)
            ++several;
        else if (!strips.front().time)
            ++unread;
        else
            ms.push_back(photon::age_ms(now, *strips.front().time));
    }

private:
    photon::StripFinder finder_{1};
    photon::GreyImage grey_;
};

// A figure needs as many; a slow machine is given more time for them.
constexpr int figure_pictures = 5;

// Throws Error if the ages are none.
void check_ages(const StripAges& ages) {
    constexpr auto least = std::size_t(figure_pictures);
    if (ages.pictures == 0)
        throw Error("No picture came, so no strip was read.");
    if (std::size_t(ages.pictures) < least)
        throw Error("Only " + std::to_string(ages.pictures) +
                    " pictures came, fewer than a figure needs; read for longer (--seconds), or "
                    "draw smaller ones (--size).");
    if (ages.ms.size() < least) {
        const std::string of = " of " + std::to_string(ages.pictures) + " pictures";
        if (ages.several > ages.without && ages.several > ages.unread)
            throw Error("There are several strips in " + std::to_string(ages.several) + of +
                        "; look where only one is seen.");
        if (ages.unread > ages.without)
            throw Error("A strip is seen in " + std::to_string(ages.unread) + of +
                        ", but its time cannot be read; show it larger or sharper.");
        throw Error("No strip is seen in " + std::to_string(ages.without) + of +
                    "; it must be at least 48 pixels wide, with its white border. "
                    "--save FILE.png keeps the last picture.");
    }
    const auto negative =
        std::count_if(ages.ms.begin(), ages.ms.end(), [](double age) { return age < -1; });
    if (std::size_t(negative) * 10 > ages.ms.size())
        throw Error(
            "The strip is ahead of this computer's time: another computer shows it. Run "
            "'theatron photon show' on this one, or film both screens.");
}

nlohmann::json stages_json(const photon::StageSum& stages) {
    nlohmann::json list = nlohmann::json::array();
    for (const photon::Stage& stage : stages.means())
        list.push_back(
            {{"until", stage.id}, {"what", stage.name}, {"mean_ms", tenths(stage.mean_ms)}});
    return list;
}

void print_stages(const photon::StageSum& stages) {
    for (const photon::Stage& stage : stages.means()) {
        char number[40];
        std::snprintf(number, sizeof number, "  %6.1f ms  ", stage.mean_ms);
        output::print(number + stage.name + "\n");
    }
}

void print_ages(const PhotonRead& wanted, const StripAges& ages, const photon::StageSum& stages) {
    const photon::Spread spread = photon::spread_of(ages.ms);
    if (wanted.json) {
        output::result(files::json_text({{"source", is_session_link(wanted.sources.front())
                                                        ? "session"
                                                        : wanted.sources.front()},
                                         {"age_ms", spread_json(spread)},
                                         {"pictures", ages.pictures},
                                         {"read", ages.ms.size()},
                                         {"unread", ages.unread},
                                         {"without_strip", ages.without},
                                         {"several_strips", ages.several},
                                         {"stages", stages_json(stages)}}) +
                       "\n");
        return;
    }
    char text[300];
    std::snprintf(text, sizeof text,
                  "age in the picture  mean %.1f ms, median %.1f, 5 %% below %.1f, 5 %% above "
                  "%.1f, most %.1f; read in %zu of %d pictures\n",
                  spread.mean, spread.median, spread.p5, spread.p95, spread.most, ages.ms.size(),
                  ages.pictures);
    output::print(text);
    print_stages(stages);
}

// Throws Error if there is nothing to draw.
void write_stages(const PhotonRead& wanted, const photon::StageSum& stages) {
    if (wanted.plot.empty())
        return;
    if (stages.pictures() == 0)
        throw Error("The pictures have no stages; only those of a session's cameras do.");
    files::write_file(wanted.plot, as_bytes(photon::stages_svg(
                                       stages.means(),
                                       "Mean age of the drawn picture, stage by stage, without "
                                       "display")));
}

void tell_age(const StripAges& ages, TimePoint now, TimePoint& next) {
    if (!isatty(STDERR_FILENO) || now < next || ages.ms.empty())
        return;
    char text[100];
    std::snprintf(text, sizeof text, "age %.0f ms, read in %zu of %d pictures", ages.ms.back(),
                  ages.ms.size(), ages.pictures);
    output::status_line(text, output::Stream::error);
    next = now + 500ms;
}

void read_live(const PhotonRead& wanted) {
    constexpr Duration longest_start = std::chrono::seconds(30);
    check_picture_file(wanted.save);
    if (!wanted.plot.empty())
        files::require_writable(wanted.plot);
    const auto pictures = is_session_link(wanted.sources.front())
                              ? session_pictures(wanted)
                              : camera_pictures(wanted.sources.front());
    StripAges ages;
    photon::StageSum stages;
    ColorImage last;
    const TimePoint began = steady_now();
    TimePoint first{}, next_line{};
    while (!cli::stop_requested()) {
        const ColorImage* const picture = pictures->next();
        const TimePoint now = steady_now();
        if (picture) {
            // The first pictures came while the session began, and are old for that.
            constexpr Duration warm_up = std::chrono::seconds(1);
            if (first == TimePoint{})
                first = now;
            if (now - first >= warm_up) {
                if (const FrameTimes* const times = pictures->times())
                    stages.add(*times);
                ages.add(*picture, now);
            }
            if (!wanted.save.empty())
                last = *picture;
            tell_age(ages, now, next_line);
            const Duration read = now - first - warm_up - seconds_to_duration(wanted.seconds);
            if (read >= Duration{} && (ages.pictures >= figure_pictures || read > longest_start))
                break;
        } else if (first == TimePoint{}
                       ? now - began > longest_start
                       : now - first > seconds_to_duration(wanted.seconds) + longest_start) {
            break;
        }
    }
    output::end_status_line();
    if (!last.empty())
        files::write_png(wanted.save, last.view());
    check_ages(ages);
    print_ages(wanted, ages, stages);
    write_stages(wanted, stages);
}

}  // namespace

void run_photon_read(const PhotonRead& wanted) {
    cli::catch_stop_signals();
    const bool files = std::any_of(wanted.sources.begin(), wanted.sources.end(), is_picture_file);
    if (files && !std::all_of(wanted.sources.begin(), wanted.sources.end(), is_picture_file))
        throw Error("Name either pictures (.png) or one link or camera, not both.");
    if (files)
        return read_files(wanted);
    if (wanted.sources.size() > 1)
        throw Error("Only one link or camera can be read at a time.");
    read_live(wanted);
    cli::begin_end();
}

}  // namespace theatron::app
