// SPDX-License-Identifier: Apache-2.0
#include "window_status.h"

#include <algorithm>
#include <cmath>

#include "client/participant_figures.h"
#include "host/filter_choice.h"
#include "wire/condition_text.h"

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

// "2 live", or "1 live, 1 stale".
xr::Fact cameras_fact(const std::vector<client::CameraFigures>& cameras) {
    using Condition = wire::CameraCondition;
    std::string text;
    bool trouble = false;
    for (const Condition condition :
         {Condition::live, Condition::stale, Condition::ended, Condition::failed}) {
        const auto count = std::count_if(cameras.begin(), cameras.end(), [&](const auto& camera) {
            return camera.camera.state.condition == condition;
        });
        if (count == 0)
            continue;
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + wire::text_of(condition);
        trouble = trouble || condition != Condition::live;
    }
    return {"Cameras", text.empty() ? "none" : text, trouble};
}

// The one text that all cameras have, "several" if they differ, "none" if there is none.
template <class TextOf>
std::string common(const std::vector<client::CameraFigures>& cameras, const TextOf& text_of) {
    std::string text;
    for (const auto& camera : cameras) {
        const std::string value = text_of(camera);
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

std::vector<xr::Fact> window_facts(const client::Participant& participant, const OnScreen& screen) {
    const auto status = participant.status();
    const bool joined = status.phase == client::Participant::Phase::joined;
    std::vector<xr::Fact> facts;
    facts.push_back({"Host", status.host_name.empty() ? screen.address : status.host_name});
    if (!joined)
        facts.push_back(
            {"Connection",
             status.phase == client::Participant::Phase::connecting ? "connecting" : "none",
             status.phase != client::Participant::Phase::connecting});
    const xr::Fact age{"Age of picture", screen.age_ms ? age_text(*screen.age_ms) : "unknown",
                       screen.age_ms && *screen.age_ms > old_ms};
    if (joined) {
        const client::ParticipantFigures figures = client::figures_of(participant);
        const auto& cameras = figures.cameras;
        facts.push_back(cameras_fact(cameras));
        if (screen.has_picture)
            facts.push_back(age);
        facts.push_back({"Received", rounded(figures.live_frames_per_second(), 0, "fps")});
        facts.push_back({"Drawn", rounded(screen.drawn_per_second, 0, "fps")});
        facts.push_back({"Data", rounded(figures.mbit_per_second(), 1, "Mbit/s")});
        facts.push_back({"Dropped", std::to_string(figures.dropped())});
        if (status.delivery.level > 0)
            facts.push_back({"Sent", status.delivery.what, true});
        facts.push_back({"Depth", common(cameras, [](const auto& c) { return c.depth.codec; })});
        facts.push_back({"Colour", common(cameras, [](const auto& c) { return c.color.codec; })});
        const std::string filter =
            common(cameras, [](const auto& c) { return c.camera.state.filter; });
        facts.push_back({"Filter", host::shown_filter(filter == "none" ? std::string() : filter)});
    } else if (screen.has_picture) {
        facts.push_back(age);
    }
    facts.push_back({"Drawing", drawing_text(screen)});
    facts.push_back({"Help", "F1"});
    return facts;
}

std::string window_warning(const client::Participant::Status& status, const OnScreen& screen) {
    constexpr double still_ms = 2000;
    const bool joined =
        status.phase == client::Participant::Phase::joined;  // else the message tells
    if (!joined || !screen.has_picture || !screen.age_ms || *screen.age_ms < still_ms)
        return {};
    return "This picture is " + age_text(*screen.age_ms) + " old";
}

WindowMessage window_message(const client::Participant::Status& status, const OnScreen& screen) {
    const std::string old = screen.has_picture && screen.age_ms && *screen.age_ms >= 1000
                                ? "This picture is " + age_text(*screen.age_ms) + " old. "
                                : "";
    switch (status.phase) {
        case client::Participant::Phase::joined:
            if (!screen.has_picture)
                return {"Waiting for the first picture…", ""};
            return {};
        case client::Participant::Phase::connecting:
            return {"Connecting…", screen.address};
        case client::Participant::Phase::lost:
            return {status.joins > 0 ? "Connection lost, trying again…"
                                     : "No connection yet, trying again…",
                    old + status.problem};
        case client::Participant::Phase::refused:
            return {"The host does not let you in", status.problem + " Press Esc to leave."};
        case client::Participant::Phase::ended:
            return {"The session is over", old + status.problem + " Press Esc to leave."};
    }
    return {};
}

}  // namespace theatron::app
