// SPDX-License-Identifier: Apache-2.0
// The figures of the participants and their cameras.
#include <algorithm>

#include "base/log.h"
#include "base/steady_clock.h"
#include "host/host_impl.h"
#include "host/mixed_registrations.h"

namespace theatron::host {
namespace {

// A participant reports ten times a second. One that was not heard for this time has stopped, or
// its link is cut, although its connection is open.
constexpr Duration silent_publisher = std::chrono::seconds(2);

wire::CameraCondition condition_here(const std::optional<wire::CameraState>& said, bool is_silent) {
    const auto condition = said ? said->condition : wire::CameraCondition::live;
    return condition == wire::CameraCondition::live && is_silent ? wire::CameraCondition::stale
                                                                 : condition;
}

}  // namespace

void Host::Impl::note_participants() {
    const auto relayed_cameras = [&](ParticipantId id,
                                     const std::vector<wire::StreamReport>& report) {
        std::set<CameraId> cameras;
        for (const wire::StreamReport& stream : report)
            if (session->relays().is_by_relay(id, stream.relayed))
                cameras.insert(camera_of(stream.stream));
        return cameras;
    };
    std::vector<HostFigures::Participant> list;
    for (const auto& [id, participant] : session->participants())
        if (participant.joined)
            list.push_back({id, participant.name, session->step_of(id), participant.report,
                            participant.renderer, participant.budget.refused(), participant.denied,
                            participant.refused_pictures, participant.role, participant.muted,
                            participant.link, participant.hand_raised,
                            session->relays().relay_of(id),
                            relayed_cameras(id, participant.report)});
    participants = list.size();
    const auto& all = session->participants();
    media.keep_everything(std::any_of(all.begin(), all.end(), [](const auto& entry) {
        return entry.second.joined && entry.second.records;
    }));
    const TimePoint now = steady_now();
    const auto is_silent = [&](ParticipantId publisher) {
        const auto last = heard.find(net::PeerId(std::uint32_t(publisher)));
        return last != heard.end() && now - last->second > silent_publisher;
    };
    const session::SessionCameras& cameras = session->streams().cameras();
    std::erase_if(dropped_slow, [&](const auto& entry) { return !cameras.find(entry.first); });
    std::erase_if(received, [&](const auto& entry) { return !cameras.find(entry.first); });
    std::map<CameraId, session::CameraAdjustment> adjusted;
    for (const wire::Camera& camera : cameras.descriptions())
        if (!camera.adjustment.empty())
            adjusted[camera.id] = cameras.find(camera.id)->adjustment();
    std::vector<HostFigures::Published> published;
    for (const wire::Camera& camera : cameras.descriptions())
        if (camera.publisher != session::host_publisher) {
            const auto& state = cameras.find(camera.id)->state;
            const auto& sync_offset = received[camera.id].sync_offset;
            published.push_back(
                {camera.id, camera.name, camera.publisher,
                 condition_here(state, is_silent(camera.publisher)), dropped_slow[camera.id],
                 camera.kind == wire::CameraKind::face, received[camera.id].bytes,
                 sync_offset ? std::optional(to_seconds(*sync_offset)) : std::nullopt,
                 state ? state->filter : "", state ? state->filter_device : ""});
        }
    std::string problem_of_places = mixed_registrations(cameras.descriptions());
    if (problem_of_places != registration_problem && !problem_of_places.empty())
        log::warning("host", "cameras of different registrations",
                     {{"problem", problem_of_places}});
    std::vector<std::string> problems_of_cases = case_problems();
    const std::lock_guard lock(figures_mutex);
    registration_problem = std::move(problem_of_places);
    case_problem_figures = std::move(problems_of_cases);
    participant_figures = std::move(list);
    visitor_figures = session->visitors();
    tokens_held_back = session->tokens_of_removed();
    ended_figure = session->has_ended();
    past_figure = session->past_bytes();
    published_figures = std::move(published);
    adjusted_figures = std::move(adjusted);
    dropped_slow_figures = dropped_slow;
}

}  // namespace theatron::host
