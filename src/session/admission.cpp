// SPDX-License-Identifier: Apache-2.0
#include "session/admission.h"

#include <algorithm>

#include "base/shown_name.h"
#include "session/audit_event.h"

namespace theatron::session {
namespace {

using wire::TextCode;

// Nobody gives himself a role, or the mark of people in a replay, who are not there.
std::string name_of_guest(const std::string& given) {
    std::vector<std::string> facts{"recorded", "recorder", "records",    "host",      "muted",
                                   "you",      "Experte",  "Beobachter", "Gastgeber", "stumm"};
    for (const Role role : wire::roles)
        facts.push_back(wire::text_of(role));
    const std::string name = person_name(given, facts, wire::max_name);
    return name.empty() ? "guest" : name;
}

}  // namespace

bool Admission::Participant::has(wire::Feature feature) const {
    return std::find(features.begin(), features.end(), feature) != features.end();
}

void Admission::on_connected(ParticipantId id, std::size_t streams, TimePoint now) {
    const auto found = participants_.try_emplace(id, streams).first;
    found->second.connected = now;
}

Admission::Participant* Admission::find(ParticipantId id) {
    const auto found = participants_.find(id);
    return found == participants_.end() ? nullptr : &found->second;
}

Admission::Verdict Admission::judge(const wire::Join& hello, TimePoint now) const {
    if (hello.protocol_min > wire::protocol_max)
        return {{},
                "",
                {TextCode::host_too_old,
                 {std::to_string(wire::protocol_max), std::to_string(hello.protocol_min)}}};
    if (hello.protocol_max < wire::protocol_min)
        return {{},
                "",
                {TextCode::program_too_old,
                 {std::to_string(hello.protocol_max), std::to_string(wire::protocol_min)}}};
    // All are compared, so that the time that it takes says nothing about which one is right.
    const Token* shown = nullptr;
    for (const Token& token : tokens_)
        if (equal_secrets_(hello.token, token.secret))
            shown = &token;
    if (!shown)
        return {{}, "", {TextCode::wrong_token}};
    if (shown->has_expired(now, shown->expires_utc ? utc_now_() : 0))
        return {{}, "", {TextCode::link_expired}};
    const auto recorders = std::count_if(
        participants_.begin(), participants_.end(),
        [](const auto& entry) { return entry.second.takes_part() && entry.second.records; });
    if (hello.records && recorders >= max_recorders)
        return {{}, "", {TextCode::too_many_recordings, {std::to_string(max_recorders)}}};
    return {shown->role, shown->link, full(hello, shown->role)};
}

wire::Text Admission::full(const wire::Join& hello, Role role) const {
    int all = 0, by_this_link = 0;
    for (const auto& [id, there] : participants_) {
        const bool is_the_same_person = !hello.person.empty() && there.person == hello.person;
        if ((!there.takes_part() && !there.waits()) || is_the_same_person)
            continue;
        ++all;
        by_this_link += there.token == hello.token;
    }
    const bool manages = may(role, Right::manage);
    if (all >= max_participants - (manages ? 0 : kept_for_operators))
        return {TextCode::all_places_taken, {std::to_string(max_participants)}};
    if (!manages && by_this_link >= max_by_one_link)
        return {TextCode::link_full, {std::to_string(max_by_one_link)}};
    return {};
}

bool Admission::is_door_full(const wire::Join& hello) const {
    std::size_t all = 0;
    int by_this_link = 0;
    for (const auto& [id, there] : participants_)
        if (there.waits()) {
            ++all;
            by_this_link += there.token == hello.token;
        }
    return all >= wire::max_visitors || by_this_link >= max_visitors_by_one_link;
}

bool Admission::knows(const Participant& participant) const {
    return std::any_of(tokens_.begin(), tokens_.end(), [&](const Token& token) {
        return token.link == participant.link && equal_secrets_(participant.token, token.secret);
    });
}

std::vector<std::string> Admission::names_beside(const Participant& participant) const {
    std::vector<std::string> names;
    for (const auto& [id, there] : participants_) {
        const bool is_the_same_person =
            &there == &participant ||
            (!participant.person.empty() && there.person == participant.person);
        if ((there.takes_part() || there.waits()) && !is_the_same_person)
            names.push_back(there.name);
    }
    return names;
}

void Admission::note(Participant& participant, const wire::Join& hello,
                     const Verdict& verdict) const {
    participant.protocol = std::min(hello.protocol_max, wire::protocol_max);
    participant.of_link = participant.role = verdict.role;
    participant.link = verdict.link;
    participant.token = hello.token;
    participant.person = hello.person;
    participant.records = hello.records;
    participant.given_name = name_of_guest(hello.name);
    // The audit log names whoever sits at the host's machine so.
    std::vector<std::string> others = names_beside(participant);
    others.push_back(at_the_host);
    participant.name = told_apart(participant.given_name, others, wire::max_name);
    participant.asks_to_publish =
        std::count(hello.features.begin(), hello.features.end(), wire::Feature::publish) > 0;
}

void Admission::admit(Participant& participant, const wire::Join& hello) {
    participant.joined = true;
    participant.asked.reset();
    participant.features = features_of(hello, participant.role);
}

std::vector<wire::Feature> Admission::features_of(const wire::Join& hello, Role role) {
    std::vector<wire::Feature> features;
    for (const wire::Feature known :
         {wire::Feature::publish, wire::Feature::sends_only, wire::Feature::room,
          wire::Feature::cases, wire::Feature::voice_consent, wire::Feature::adjusting,
          wire::Feature::playback, wire::Feature::screens, wire::Feature::look_back,
          wire::Feature::webcam, wire::Feature::patient, wire::Feature::direct}) {
        const bool is_asked =
            std::find(hello.features.begin(), hello.features.end(), known) != hello.features.end();
        if (is_asked && (known != wire::Feature::publish || may(role, Right::publish)))
            features.push_back(known);
    }
    return features;
}

void Admission::keep_for_later(Participant& participant, wire::ToHost message) {
    const auto keep = [&](std::optional<CameraId> camera, const wire::ChooseCodecs& wish) {
        wire::ChooseCodecs& late = participant.late_codecs[camera];
        if (!wish.depth_codec.empty())
            late.depth_codec = wish.depth_codec;
        if (!wish.color_codec.empty())
            late.color_codec = wish.color_codec;
        if (camera)
            late.cameras = {*camera};
    };
    if (const auto* wish = std::get_if<wire::ChooseCodecs>(&message)) {
        if (wish->cameras.empty()) {
            // Requests that were kept for single cameras no longer hold.
            for (auto& [camera, late] : participant.late_codecs) {
                if (!wish->depth_codec.empty())
                    late.depth_codec.clear();
                if (!wish->color_codec.empty())
                    late.color_codec.clear();
            }
            keep(std::nullopt, *wish);
        }
        for (const CameraId camera : wish->cameras)
            if (participant.late_codecs.size() <= wire::max_cameras)
                keep(camera, *wish);
    } else if (const auto* goal = std::get_if<wire::ChooseDelivery>(&message)) {
        participant.late_goal = *goal;
    }
}

}  // namespace theatron::session
