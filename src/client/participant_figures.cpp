// SPDX-License-Identifier: Apache-2.0
#include "client/participant_figures.h"

#include <algorithm>

#include "session/permissions.h"
#include "wire/condition_text.h"
#include "wire/no_codec.h"
#include "wire/sentence.h"

namespace theatron::client {

const receive::StreamFigures* CameraFigures::seen() const {
    if (depth.codec != wire::no_codec)
        return &depth;
    return color.codec.empty() || color.codec == wire::no_codec ? nullptr : &color;
}

const char* text_of(Participant::Phase phase) {
    switch (phase) {
        case Participant::Phase::connecting:
            return "connecting";
        case Participant::Phase::waiting:
            return "waiting";
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

double ParticipantFigures::frames_per_second() const {
    std::optional<double> least;
    for (const CameraFigures& camera : cameras)
        if (const receive::StreamFigures* seen = camera.seen())
            least = std::min(least.value_or(seen->frames_per_second), seen->frames_per_second);
    return least.value_or(0);
}

double ParticipantFigures::live_frames_per_second() const {
    std::optional<double> least;
    for (const CameraFigures& camera : cameras)
        if (const receive::StreamFigures* seen = camera.seen();
            seen && camera.camera.state.condition == wire::CameraCondition::live)
            least = std::min(least.value_or(seen->frames_per_second), seen->frames_per_second);
    return least.value_or(0);
}

double ParticipantFigures::mbit_per_second() const {
    double sum = 0;
    for (const CameraFigures& camera : cameras)
        sum += camera.mbit_per_second();
    return sum;
}

std::uint64_t ParticipantFigures::dropped() const {
    std::uint64_t sum = 0;
    for (const CameraFigures& camera : cameras)
        sum += camera.dropped();
    return sum;
}

const char* state_text(const CameraFigures& camera) {
    const wire::CameraCondition condition = camera.camera.state.condition;
    if (camera.played == CameraFigures::Played::no || condition != wire::CameraCondition::live)
        return wire::text_of(condition);
    return camera.played == CameraFigures::Played::paused ? "paused" : "recording";
}

std::string problem_text(const wire::CameraState& state, wire::Role reader) {
    return session::may(reader, session::Right::adjust)
               ? wire::sentence(state.problem)
               : wire::sentence_without_advice(state.problem);
}

std::string adjustment_text(const wire::Camera& camera) {
    const auto adjustment = session::decode_adjustment(camera.adjustment);
    if (!adjustment)
        return say(Phrase::adjusted_by_newer);
    return *adjustment == session::CameraAdjustment{} ? "" : text_of(*adjustment);
}

std::string recorded_text(const ParticipantFigures& figures) {
    std::string text;
    for (const auto& [name, lasts] : figures.recordings) {
        const auto seconds = std::max<std::int64_t>(lasts / std::chrono::seconds(1), 0);
        text += say(
            text.empty() ? Phrase::recorded_by : Phrase::recorded_by_also, name,
            seconds < 120 ? std::to_string(seconds) + " s" : std::to_string(seconds / 60) + " min");
    }
    return text;
}

std::vector<receive::StreamFigures> without_ages(std::vector<receive::StreamFigures> figures) {
    for (receive::StreamFigures& stream : figures)
        stream.age_ms = stream.age_now_ms = stream.age_p50_ms = stream.age_p95_ms =
            stream.age_p99_ms = stream.age_max_ms = stream.awaited_ms = 0;
    return figures;
}

std::vector<receive::StreamFigures> counted_anew(
    const std::vector<receive::StreamFigures>& figures) {
    std::vector<receive::StreamFigures> all;
    for (const receive::StreamFigures& told : figures) {
        receive::StreamFigures anew;
        anew.stream = told.stream;
        anew.codec = told.codec;
        anew.age_now_ms = told.age_now_ms;
        anew.has_come = told.has_come;
        all.push_back(anew);
    }
    return all;
}

std::vector<receive::StreamFigures> aged_by(Duration later,
                                            std::vector<receive::StreamFigures> figures) {
    for (receive::StreamFigures& stream : figures)
        if (stream.has_come)
            stream.age_now_ms += to_ms(later);
    return figures;
}

wire::CameraState state_here(const wire::CameraState& said, const receive::StreamFigures& seen,
                             bool is_thinned) {
    constexpr double silent_ms = 2000, silent_ms_thinned = 5000;
    const double silent_for = seen.has_come ? seen.age_now_ms : seen.awaited_ms;
    const bool is_silent = !seen.past && silent_for > (is_thinned ? silent_ms_thinned : silent_ms);
    if (said.condition != wire::CameraCondition::live || !is_silent)
        return said;
    wire::CameraState state = said;
    state.condition = wire::CameraCondition::stale;
    state.problem = {seen.has_come ? wire::TextCode::no_pictures_come
                                   : wire::TextCode::no_picture_came};
    return state;
}

ParticipantFigures figures_of(const Participant& participant) {
    ParticipantFigures figures;
    figures.status = participant.status();
    figures.moments = participant.moments();
    std::uint64_t generation = 0;
    const auto streams = participant.figures();
    const std::set<StreamId> relayed = participant.relayed_streams();
    const auto playback = participant.playback();
    for (auto& camera : participant.cameras(generation)) {
        CameraFigures of_camera{std::move(camera), {}, {}};
        const wire::Camera& description = of_camera.camera.description;
        if (playback && description.publisher == ParticipantId{})
            of_camera.played =
                playback->paused ? CameraFigures::Played::paused : CameraFigures::Played::goes_on;
        of_camera.relayed = relayed.contains(description.depth_stream);
        for (const auto& stream : streams) {
            if (stream.stream == description.depth_stream)
                of_camera.depth = stream;
            else if (description.has_color && stream.stream == description.color_stream)
                of_camera.color = stream;
        }
        if (const receive::StreamFigures* seen = of_camera.seen())
            of_camera.camera.state =
                state_here(of_camera.camera.state, *seen, figures.status.delivery.level > 0);
        figures.cameras.push_back(std::move(of_camera));
    }
    for (const Participant::Recording& one : participant.recordings())
        figures.recordings.push_back({one.name, participant.now() - one.since});
    return figures;
}

}  // namespace theatron::client
