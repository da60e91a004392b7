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
    facts.push_back(wire::text_of(Role::relay));
    for (const Role role : wire::roles)
        facts.push_back(wire::text_of(role));
    const std::string name = person_name(given, facts, wire::max_name);
    return name.empty() ? "guest" : name;
}

AdmissionMemory::Who who(const wire::Join& hello) {
    return {hello.person, hello.token, hello.records};
}
AdmissionMemory::Who who(const Admission::Participant& there) {
    return {there.person, there.token, there.records};
}

bool is_silent(const Admission::Participant& there, TimePoint now) {
    return now - there.heard > Admission::silent_after;
}

bool only_watches(const Admission::Participant& there) {
    return !there.records && !there.sends_only;
}

bool is_replaced(const Admission::Verdict& verdict, ParticipantId id) {
    return std::any_of(verdict.replaced.begin(), verdict.replaced.end(),
                       [&](const Admission::Replaced& replaced) { return replaced.id == id; });
}

}  // namespace

bool asks_for(const wire::Join& hello, wire::Feature feature) {
    return std::find(hello.features.begin(), hello.features.end(), feature) != hello.features.end();
}

bool Admission::Participant::has(wire::Feature feature) const {
    return std::find(features.begin(), features.end(), feature) != features.end();
}

void Admission::on_connected(ParticipantId id, std::size_t streams, TimePoint now) {
    const auto found = participants_.try_emplace(id, streams).first;
    found->second.connected = found->second.heard = now;
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
    if (shown->has_expired(now, shown->expires_utc ? utc_now_() : 0) && !knows_again(hello, now))
        return {shown->role, shown->link, {TextCode::link_expired}};
    Verdict verdict{shown->role, shown->link, {}, {}, {}};
    if (const auto* left = memory_.find(who(hello), now))
        verdict.since = now - (left->until - left->since);
    replace_own(hello, now, verdict);
    if (verdict.refusal.empty() && hello.records)
        find_recorder_place(hello, now, verdict);
    if (verdict.refusal.empty())
        find_place(hello, verdict);
    return verdict;
}

std::vector<ParticipantId> Admission::connections_of(const Bytes& person) const {
    std::vector<ParticipantId> own;
    for (const auto& [id, there] : participants_)
        if (there.is_there() && !person.empty() && there.person == person)
            own.push_back(id);
    return own;
}

bool Admission::knows_again(const wire::Join& hello, TimePoint now) const {
    const std::vector<ParticipantId> own = connections_of(hello.person);
    return memory_.find(who(hello), now) || std::any_of(own.begin(), own.end(), [&](auto id) {
               return who(participants_.at(id)) == who(hello);
           });
}

void Admission::remember(const Participant& participant) {
    memory_.note({who(participant), participant.since, participant.heard});
}

void Admission::replace_own(const wire::Join& hello, TimePoint now, Verdict& verdict) const {
    const bool sends_only = asks_for(hello, wire::Feature::sends_only);
    std::vector<ParticipantId> others;
    for (const ParticipantId id : connections_of(hello.person)) {
        const Participant& there = participants_.at(id);
        const bool is_same = hello.run != 0 && there.run == hello.run;
        // A silent recorder may still get what is kept for it.
        const bool is_lost = is_silent(there, now) && !there.records;
        if (who(there) != who(hello) || there.sends_only != sends_only || !(is_same || is_lost)) {
            others.push_back(id);
            continue;
        }
        verdict.replaced.push_back({id, {}});
        verdict.since = std::min(verdict.since.value_or(there.since), there.since);
    }
    if (int(others.size()) < max_of_one_person)
        return;
    const auto first = [&](auto is_right) {
        return std::find_if(others.begin(), others.end(),
                            [&](ParticipantId id) { return is_right(participants_.at(id)); });
    };
    const auto silent = first([&](const Participant& p) { return is_silent(p, now); });
    const auto watching = first([](const Participant& p) { return only_watches(p); });
    const std::string most = std::to_string(max_of_one_person);
    if (silent != others.end())
        verdict.replaced.push_back({*silent, {}});
    else if (watching != others.end())
        verdict.replaced.push_back({*watching, {TextCode::came_in_again, {most}}});
    else
        verdict.refusal = {TextCode::person_is_in_often, {most}};
}

void Admission::find_recorder_place(const wire::Join& hello, TimePoint now,
                                    Verdict& verdict) const {
    int recorders = 0;
    std::optional<ParticipantId> silent;
    for (const auto& [id, there] : participants_) {
        if (!there.takes_part() || !there.records || is_replaced(verdict, id))
            continue;
        ++recorders;
        if (!hello.person.empty() && there.person == hello.person && is_silent(there, now))
            silent = id;
    }
    if (recorders < max_recorders + (verdict.since ? kept_for_returned_recorders : 0))
        return;
    if (silent)
        verdict.replaced.push_back({*silent, {}});
    else
        give_place([](const Participant& there) { return there.takes_part() && there.records; },
                   {TextCode::too_many_recordings, {std::to_string(max_recorders)}}, verdict);
}

void Admission::find_place(const wire::Join& hello, Verdict& verdict) const {
    int all = 0, by_this_link = 0;
    for (const auto& [id, there] : participants_) {
        if (!there.is_there() || is_replaced(verdict, id))
            continue;
        ++all;
        by_this_link += there.token == hello.token;
    }
    const bool manages = may(verdict.role, Right::manage);
    wire::Text full;
    std::string link;
    if (all >= max_participants - (manages ? 0 : kept_for_operators)) {
        full = {TextCode::all_places_taken, {std::to_string(max_participants)}};
    } else if (!manages && by_this_link >= max_by_one_link) {
        full = {TextCode::link_full, {std::to_string(max_by_one_link)}};
        link = hello.token;
    }
    if (!full.empty())
        give_place(
            [&](const Participant& there) {
                return there.is_there() && (link.empty() || there.token == link);
            },
            std::move(full), verdict);
}

void Admission::give_place(const std::function<bool(const Participant&)>& may_go, wire::Text full,
                           Verdict& verdict) const {
    const std::pair<const ParticipantId, Participant>* newest = nullptr;
    // Those who only watch make way first.
    const auto rank = [](const Participant& there) {
        return std::pair(only_watches(there), there.since);
    };
    for (const auto& entry : participants_) {
        const auto& [id, there] = entry;
        const bool goes =
            may_go(there) && !session::may(there.role, Right::manage) && !is_replaced(verdict, id);
        if (goes && verdict.since && there.since > *verdict.since &&
            (!newest || rank(there) >= rank(newest->second)))
            newest = &entry;
    }
    if (newest)
        verdict.replaced.push_back({newest->first, std::move(full)});
    else
        verdict.refusal = std::move(full);
}

void Admission::find_door_place(const wire::Join& hello, Verdict& verdict) const {
    std::size_t all = 0;
    int by_this_link = 0;
    for (const auto& [id, there] : participants_)
        if (there.waits() && !is_replaced(verdict, id)) {
            ++all;
            by_this_link += there.token == hello.token;
        }
    if (all < wire::max_visitors && by_this_link < max_visitors_by_one_link)
        return;
    const bool by_any_link = all >= wire::max_visitors;
    give_place(
        [&](const Participant& there) {
            return there.waits() && (by_any_link || there.token == hello.token);
        },
        {TextCode::too_many_visitors}, verdict);
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
        if (there.is_there() && !is_the_same_person)
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
    participant.run = hello.run;
    participant.since = verdict.since.value_or(participant.connected);
    participant.records = hello.records;
    participant.sends_only =
        verdict.role == Role::relay || asks_for(hello, wire::Feature::sends_only);
    participant.given_name = name_of_guest(hello.name);
    // The audit log names whoever sits at the host's machine so.
    std::vector<std::string> others = names_beside(participant);
    others.push_back(at_the_host);
    // Programs put such a word in place of their own person's name.
    for (const char* reader : {"You", "Sie", "Du", "Vous", "Toi"})
        others.emplace_back(reader);
    participant.name = told_apart(participant.given_name, others, wire::max_name);
    participant.asks_to_publish = asks_for(hello, wire::Feature::publish);
}

void Admission::admit(Participant& participant, const wire::Join& hello) {
    participant.joined = true;
    participant.asked.reset();
    participant.features = features_of(hello, participant.role);
}

std::vector<wire::Feature> Admission::features_of(const wire::Join& hello, Role role) {
    // A relay has no part in the session, and sees nothing of it.
    if (role == Role::relay)
        return {wire::Feature::sends_only, wire::Feature::relays};
    std::vector<wire::Feature> features;
    for (const wire::Feature known :
         {wire::Feature::publish, wire::Feature::sends_only, wire::Feature::room,
          wire::Feature::cases, wire::Feature::voice_consent, wire::Feature::adjusting,
          wire::Feature::playback, wire::Feature::screens, wire::Feature::look_back,
          wire::Feature::webcam, wire::Feature::patient, wire::Feature::relay,
          wire::Feature::asks_patient, wire::Feature::shows_screen, wire::Feature::study,
          wire::Feature::draws_flat, wire::Feature::chat}) {
        if (asks_for(hello, known) &&
            (known != wire::Feature::publish || may(role, Right::publish)))
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
