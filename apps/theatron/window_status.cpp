// SPDX-License-Identifier: Apache-2.0
#include "window_status.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "filter_choice.h"
#include "participant_figures.h"

namespace theatron::app {
namespace {

// What the eye does not notice in an operation, and what it does.
constexpr double old_ms = 500;

std::string rounded(double value, int digits, const char* unit) {
    char text[40];
    std::snprintf(text, sizeof(text), "%.*f %s", digits, value, unit);
    return text;
}

std::string age_text(double ms) {
    if (ms < 1000)
        return rounded(ms, 0, "ms");
    if (ms < 120'000)
        return rounded(std::floor(ms / 1000), 0, "s");
    return rounded(std::floor(ms / 60'000), 0, "min");
}

const std::string& text_of(const nlohmann::json& camera, const char* field) {
    return camera[field].get_ref<const std::string&>();
}

// "2 live", or "1 live, 1 stale".
xr::Fact cameras_fact(const nlohmann::json& cameras) {
    std::string text;
    bool trouble = false;
    for (const char* state : {"live", "stale", "ended", "failed"}) {
        int count = 0;
        for (const auto& camera : cameras)
            count += text_of(camera, "state") == state;
        if (count == 0)
            continue;
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + state;
        trouble = trouble || state != std::string("live");
    }
    return {"Cameras", text.empty() ? "none" : text, trouble};
}

// The slowest of those that should deliver.
double received_per_second(const nlohmann::json& cameras) {
    std::optional<double> least;
    for (const auto& camera : cameras)
        if (text_of(camera, "state") == "live")
            least = std::min(least.value_or(1e9), camera["fps"].get<double>());
    return least.value_or(0);
}

// What the cameras have in common, or that they differ.
std::string common(const nlohmann::json& cameras, const char* field) {
    std::string text;
    for (const auto& camera : cameras) {
        const std::string& value = text_of(camera, field);
        if (value.empty() || value == text)
            continue;
        if (!text.empty())
            return "several";
        text = value;
    }
    return text.empty() ? "none" : text;
}

// "blend (auto)", "mesh, set by host, coarser".
std::string drawing_text(const OnScreen& screen) {
    std::string text = screen.way.renderer;
    if (screen.renderer_by == OnScreen::By::program)
        text += " (auto)";
    if (screen.renderer_by == OnScreen::By::host)
        text += ", set by host";
    if (screen.way.scale < 1 || screen.way.depth_step > 1)
        text += ", coarser";
    return text;
}

}  // namespace

std::vector<xr::Fact> window_facts(const Participant& participant, const OnScreen& screen) {
    const auto status = participant.status();
    const bool joined = status.phase == Participant::Phase::joined;
    std::vector<xr::Fact> facts;
    facts.push_back({"Host", status.host_name.empty() ? screen.address : status.host_name});
    if (!joined)
        facts.push_back({"Connection",
                         status.phase == Participant::Phase::connecting ? "connecting" : "none",
                         status.phase != Participant::Phase::connecting});
    const xr::Fact age{"Age of picture", screen.age_ms ? age_text(*screen.age_ms) : "unknown",
                       screen.age_ms && *screen.age_ms > old_ms};
    if (joined) {
        const nlohmann::json f = participant_figures(participant);
        const auto& cameras = f["cameras"];
        facts.push_back(cameras_fact(cameras));
        if (screen.has_picture)
            facts.push_back(age);
        facts.push_back({"Received", rounded(received_per_second(cameras), 0, "fps")});
        facts.push_back({"Drawn", rounded(screen.drawn_per_second, 0, "fps")});
        facts.push_back({"Data", rounded(f["mbit_per_s"], 1, "Mbit/s")});
        facts.push_back({"Dropped", std::to_string(f["dropped"].get<std::uint64_t>())});
        if (status.delivery.level > 0)
            facts.push_back({"Sent", status.delivery.what, true});
        facts.push_back({"Depth", common(cameras, "depth_codec")});
        facts.push_back({"Colour", common(cameras, "color_codec")});
        const std::string filter = common(cameras, "filter");
        facts.push_back({"Filter", shown_filter(filter == "none" ? std::string() : filter)});
    } else if (screen.has_picture) {
        facts.push_back(age);
    }
    facts.push_back({"Drawing", drawing_text(screen)});
    facts.push_back({"Help", "F1"});
    return facts;
}

std::string window_warning(const Participant::Status& status, const OnScreen& screen) {
    constexpr double still_ms = 2000;
    const bool joined = status.phase == Participant::Phase::joined;  // else the message tells
    if (!joined || !screen.has_picture || !screen.age_ms || *screen.age_ms < still_ms)
        return {};
    return "This picture is " + age_text(*screen.age_ms) + " old";
}

WindowMessage window_message(const Participant::Status& status, const OnScreen& screen) {
    const std::string old = screen.has_picture && screen.age_ms && *screen.age_ms >= 1000
                                ? "This picture is " + age_text(*screen.age_ms) + " old. "
                                : "";
    switch (status.phase) {
        case Participant::Phase::joined:
            if (!screen.has_picture)
                return {"Waiting for the first picture…", ""};
            return {};
        case Participant::Phase::connecting:
            return {"Connecting…", screen.address};
        case Participant::Phase::lost:
            return {status.joins > 0 ? "Connection lost, trying again…"
                                     : "No connection yet, trying again…",
                    old + status.problem};
        case Participant::Phase::refused:
            return {"The host does not let you in", status.problem + " Press Esc to leave."};
        case Participant::Phase::ended:
            return {"The session is over", old + status.problem + " Press Esc to leave."};
    }
    return {};
}

}  // namespace theatron::app
