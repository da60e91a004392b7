// SPDX-License-Identifier: Apache-2.0
#include "participant_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/utc.h"
#include "host/host_figures.h"
#include "viewer/age_text.h"
#include "viewer/playing.h"

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

nlohmann::json age_json(const StreamAge& age) {
    return {{"p50", age.p50}, {"p99", age.p99}, {"max", age.max}};
}

StreamAge oldest_age(const client::ParticipantFigures& figures) {
    StreamAge oldest;
    for (const client::CameraFigures& camera : figures.cameras)
        for (const receive::StreamFigures* stream : {&camera.depth, &camera.color}) {
            const StreamAge one = age_of(*stream);
            oldest.p50 = std::max(oldest.p50, one.p50);
            oldest.p99 = std::max(oldest.p99, one.p99);
            oldest.max = std::max(oldest.max, one.max);
        }
    return oldest;
}

bool is_past(const client::ParticipantFigures& figures) {
    return std::any_of(figures.cameras.begin(), figures.cameras.end(),
                       [](const client::CameraFigures& one) { return one.depth.past; });
}

std::string codecs_of_last(const client::ParticipantFigures& figures) {
    if (figures.cameras.empty())
        return "";
    const client::CameraFigures& camera = figures.cameras.back();
    return camera.depth.codec + (camera.color.codec.empty() ? "" : " " + camera.color.codec);
}

nlohmann::json position_json(const Calibration& calibration) {
    const Vec3& place = calibration.room_from_camera.translation;
    return {place.x, place.y, place.z};
}

nlohmann::json camera_json(const client::CameraFigures& figures, wire::Role reader) {
    const auto& [camera, depth, color, relayed, played] = figures;
    const auto age = [&](double ms) { return depth.frames > 0 ? nlohmann::json(ms) : nullptr; };
    return {{"id", int(camera.description.id)},
            {"publisher", int(camera.description.publisher)},
            {"name", camera.description.name},
            {"state", client::state_text(figures)},
            {"problem", client::problem_text(camera.state, reader)},
            {"filter", camera.state.filter},
            {"filter_device", camera.state.filter_device},
            {"adjusted", client::adjustment_text(camera.description)},
            {"position", position_json(camera.calibration)},
            {"fps", depth.frames_per_second},
            {"frames", depth.frames},
            {"mbit_per_s", figures.mbit_per_second()},
            {"newest_age_ms", age(depth.age_ms)},
            {"age_now_ms", depth.has_come ? nlohmann::json(depth.age_now_ms) : nullptr},
            {"past", depth.past},
            {"relayed", relayed},
            {"newest_frame", depth.newest},
            {"age_ms", age_json(age_of(depth))},
            {"color_age_ms", age_json(age_of(color))},
            {"dropped", figures.dropped()},
            {"depth_codec", depth.codec},
            {"depth_exact", text_of(depth.exact)},
            {"color_codec", color.codec}};
}

nlohmann::json playback_json(const client::Participant& participant) {
    const auto playback = participant.playback();
    if (!playback)
        return nullptr;
    return {{"position_s", to_seconds(viewer::position_at(*playback, participant.now()))},
            {"length_s", to_seconds(playback->length)},
            {"paused", playback->paused},
            {"by", playback->by}};
}

nlohmann::json visitors_json(const std::vector<wire::Visitor>& visitors) {
    nlohmann::json list = nlohmann::json::array();
    for (const wire::Visitor& visitor : visitors)
        list.push_back(host::visitor_json(visitor));
    return list;
}

}  // namespace

StreamAge age_of(const receive::StreamFigures& stream) {
    if (stream.past)
        return {stream.age_now_ms, stream.age_now_ms, stream.age_now_ms};
    return {stream.age_p50_ms, stream.age_p99_ms, stream.age_max_ms};
}

std::string age_part(const client::ParticipantFigures& figures) {
    const double p50 = oldest_age(figures).p50;
    if (is_past(figures))
        return "NOT LIVE: " + viewer::age_text(p50) + " ago";
    char text[40];
    std::snprintf(text, sizeof(text), "age %.0f ms", p50);
    return text;
}

std::string moments_part(const MomentFigures& moments) {
    if (!moments.any())
        return "";
    char apart[80] = "";
    if (moments.whole > 0)
        std::snprintf(apart, sizeof(apart), "cameras %.0f ms apart (at most %.0f), ",
                      moments.skew_p50_ms, moments.skew_max_ms);
    return apart + std::to_string(moments.unpaired) + " pictures alone";
}

nlohmann::json participant_json(const client::Participant& participant) {
    const client::ParticipantFigures figures = client::figures_of(participant);
    const client::Participant::Status& status = figures.status;
    nlohmann::json cameras = nlohmann::json::array();
    const bool joined = status.phase == client::Participant::Phase::joined;
    for (const client::CameraFigures& camera : figures.cameras) {
        cameras.push_back(camera_json(camera, status.standing.role));
        // Rates and ages are those of the last moment that was seen.
        if (!joined)
            cameras.back().update({{"state", "lost"},
                                   {"fps", 0.0},
                                   {"mbit_per_s", 0.0},
                                   {"newest_age_ms", nullptr},
                                   {"age_now_ms", nullptr}});
    }
    nlohmann::json recordings = nlohmann::json::array();
    for (const auto& [name, lasts] : figures.recordings)
        recordings.push_back({{"name", name}, {"seconds", to_seconds(lasts)}});
    return {{"utc", utc_text(utc_now())},
            {"session_us", to_us(participant.now())},
            {"host", status.host_name},
            {"recordings", recordings},
            {"playback", playback_json(participant)},
            {"phase", client::text_of(status.phase)},
            {"cameras", cameras},
            {"fps", joined ? figures.frames_per_second() : 0.0},
            {"mbit_per_s", joined ? figures.mbit_per_second() : 0.0},
            {"age_ms", age_json(oldest_age(figures))},
            {"past", is_past(figures)},
            {"dropped", figures.dropped()},
            {"skew_ms", host::skew_json(figures.moments)},
            {"unpaired", figures.moments.unpaired},
            {"codec", codecs_of_last(figures)},
            {"round_trip_ms", to_ms(status.round_trip)},
            {"clock_error_ms", to_ms(status.clock_error)},
            {"joins", status.joins},
            {"role", wire::text_of(status.standing.role)},
            {"muted", status.standing.muted},
            {"visitors", visitors_json(participant.visitors())},
            {"target_latency_ms", status.goal.target_latency_ms},
            {"max_mbit_per_s", status.goal.max_kbit_per_s / 1000.0},
            {"level", status.delivery.level},
            {"levels", status.delivery.levels},
            {"sent", wire::sent_part(status.delivery)},
            {"level_reason", wire::english(status.delivery.reason)}};
}

std::string status_line(const client::Participant& participant) {
    const client::ParticipantFigures figures = client::figures_of(participant);
    const client::Participant::Status& status = figures.status;
    if (status.phase != client::Participant::Phase::joined)
        return std::string(client::text_of(status.phase)) +
               (status.problem.empty() ? "" : ": " + status.problem);
    char text[200];
    std::snprintf(text, sizeof(text),
                  "%s: %zu camera(s)  %.1f fps  %.1f Mbit/s  %s  dropped %llu  ",
                  status.host_name.c_str(), figures.cameras.size(), figures.frames_per_second(),
                  figures.mbit_per_second(), age_part(figures).c_str(),
                  static_cast<unsigned long long>(figures.dropped()));
    std::string line = text + codecs_of_last(figures);
    if (const std::string moments = moments_part(figures.moments); !moments.empty())
        line += "  " + moments;
    if (const auto playback = participant.playback())
        line += "  " + viewer::playback_text(*playback, participant.now());
    if (const std::string recorded = client::recorded_text(figures); !recorded.empty())
        line += "  " + recorded;
    if (status.delivery.level > 0)
        line += "  sent: " + wire::sent_part(status.delivery) + " (" +
                wire::english(status.delivery.reason) + ")";
    return line;
}

}  // namespace theatron::app
