// SPDX-License-Identifier: Apache-2.0
#include "participant_figures.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace theatron::app {
namespace {

const char* text_of(receive::Exactness exact) {
    switch (exact) {
        case receive::Exactness::nowhere:
            return "nowhere";
        case receive::Exactness::region:
            return "region";
        case receive::Exactness::everywhere:
            return "everywhere";
    }
    return "unknown";
}

const char* text_of(Participant::Phase phase) {
    switch (phase) {
        case Participant::Phase::connecting:
            return "connecting";
        case Participant::Phase::joined:
            return "joined";
        case Participant::Phase::lost:
            return "lost";
        case Participant::Phase::refused:
            return "refused";
        case Participant::Phase::ended:
            return "ended";
    }
    return "unknown";
}

// Depth and colour of one camera; colour has no frames where there is none.
struct CameraFigures {
    Participant::Camera camera;
    receive::StreamFigures depth, color;
};

std::vector<CameraFigures> collect(const Participant& participant) {
    std::uint64_t generation = 0;
    std::vector<CameraFigures> result;
    const auto streams = participant.figures();
    for (const auto& camera : participant.cameras(generation)) {
        CameraFigures figures{camera, {}, {}};
        for (const auto& stream : streams) {
            if (stream.stream == camera.description.depth_stream)
                figures.depth = stream;
            else if (camera.description.has_color &&
                     stream.stream == camera.description.color_stream)
                figures.color = stream;
        }
        result.push_back(figures);
    }
    return result;
}

nlohmann::json age(const receive::StreamFigures& f) {
    return {{"p50", f.age_p50_ms}, {"p99", f.age_p99_ms}, {"max", f.age_max_ms}};
}

}  // namespace

const char* text_of(wire::CameraCondition condition) {
    switch (condition) {
        case wire::CameraCondition::live:
            return "live";
        case wire::CameraCondition::stale:
            return "stale";
        case wire::CameraCondition::ended:
            return "ended";
        case wire::CameraCondition::failed:
            return "failed";
    }
    return "unknown";
}

nlohmann::json participant_figures(const Participant& participant) {
    const auto status = participant.status();
    nlohmann::json cameras = nlohmann::json::array();
    double fps = 0, mbit = 0, p50 = 0, p99 = 0, max = 0;
    std::uint64_t dropped = 0;
    std::string codec;
    for (const auto& [camera, depth, color] : collect(participant)) {
        const double camera_mbit = depth.mbit_per_second + color.mbit_per_second;
        cameras.push_back({{"name", camera.description.name},
                           {"state", text_of(camera.state.condition)},
                           {"problem", camera.state.problem},
                           {"filter", camera.state.filter},
                           {"fps", depth.frames_per_second},
                           {"frames", depth.frames},
                           {"mbit_per_s", camera_mbit},
                           {"newest_age_ms", depth.age_ms},
                           {"age_now_ms", depth.age_now_ms},
                           {"age_ms", age(depth)},
                           {"color_age_ms", age(color)},
                           {"dropped", depth.dropped + color.dropped},
                           {"depth_codec", depth.codec},
                           {"depth_exact", text_of(depth.exact)},
                           {"color_codec", color.codec}});
        fps =
            cameras.size() == 1 ? depth.frames_per_second : std::min(fps, depth.frames_per_second);
        mbit += camera_mbit;
        p50 = std::max({p50, depth.age_p50_ms, color.age_p50_ms});
        p99 = std::max({p99, depth.age_p99_ms, color.age_p99_ms});
        max = std::max({max, depth.age_max_ms, color.age_max_ms});
        dropped += depth.dropped + color.dropped;
        codec = depth.codec + (color.codec.empty() ? "" : " " + color.codec);
    }
    return {{"host", status.host_name},
            {"phase", text_of(status.phase)},
            {"cameras", cameras},
            {"fps", fps},
            {"mbit_per_s", mbit},
            {"age_ms", {{"p50", p50}, {"p99", p99}, {"max", max}}},
            {"dropped", dropped},
            {"codec", codec},
            {"round_trip_ms", to_ms(status.round_trip)},
            {"clock_error_ms", to_ms(status.clock_error)},
            {"joins", status.joins},
            {"target_latency_ms", status.goal.target_latency_ms},
            {"max_mbit_per_s", status.goal.max_kbit_per_s / 1000.0},
            {"level", status.delivery.level},
            {"levels", status.delivery.levels},
            {"sent", status.delivery.level > 0 ? status.delivery.what : "everything"},
            {"level_reason", status.delivery.reason}};
}

std::string status_line(const Participant& participant) {
    const auto status = participant.status();
    if (status.phase != Participant::Phase::joined)
        return std::string(text_of(status.phase)) +
               (status.problem.empty() ? "" : ": " + status.problem);
    const nlohmann::json f = participant_figures(participant);
    char text[200];
    std::snprintf(text, sizeof(text),
                  "%s: %zu camera(s)  %.1f fps  %.1f Mbit/s  age %.0f ms  dropped %llu  ",
                  status.host_name.c_str(), f["cameras"].size(), f["fps"].get<double>(),
                  f["mbit_per_s"].get<double>(), f["age_ms"]["p50"].get<double>(),
                  static_cast<unsigned long long>(f["dropped"].get<std::uint64_t>()));
    std::string line = text + f["codec"].get<std::string>();
    if (status.delivery.level > 0)
        line += "  sent: " + status.delivery.what + " (" + status.delivery.reason + ")";
    return line;
}

}  // namespace theatron::app
