// SPDX-License-Identifier: Apache-2.0
// The way of a participant from its first message into the session.
#include <utility>

#include "session/host_session.h"

namespace theatron::session {

using wire::TextCode;

void HostSession::join(ParticipantId id, const wire::Join& hello, TimePoint now) {
    Admission::Verdict verdict = admission_.judge(hello, now);
    const auto refuse_entry = [&](const wire::Text& why) {
        actions_.push_back(action::Audit{{AuditEvent::What::refused, id, hello.name, hello.person,
                                          verdict.role, verdict.link, "", wire::english(why)}});
        refuse(id, why);
    };
    if (!verdict.refusal.empty())
        return refuse_entry(verdict.refusal);
    const CheckedCodec depth = checked(config_.check_depth, hello.depth_codec);
    const CheckedCodec color = checked(config_.check_color, hello.color_codec);
    for (const std::string& problem : {depth.problem, color.problem})
        if (!problem.empty())
            return refuse_entry(wire::as_written(problem));
    switch (link_budgets_.join(verdict.link, hello.person, now)) {
        case LinkBudgets::Answer::granted:
            break;
        case LinkBudgets::Answer::too_often:
            return refuse_entry(
                wire::as_written("Too many join by this link within a short time; try "
                                 "again in some seconds."));
        case LinkBudgets::Answer::after_flood:
            return refuse_entry({TextCode::too_many_requests});
    }

    const Membership::Judged judged = membership_.judge(hello.person, verdict.role, hello.records);
    if (judged.entry == Membership::Entry::was_removed ||
        membership_.is_removed_by(hello.person, hello.token))
        return refuse_entry({TextCode::removed_by_operator});
    if (has_ended_ && !may(verdict.role, Right::manage))
        return refuse_entry({TextCode::session_has_ended});
    const bool is_relay = asks_for(hello, wire::Feature::relays);
    if (is_relay != (verdict.role == Role::relay))
        return refuse_entry(wire::as_written(
            is_relay ? "A relay comes by a link of its own, which 'theatron link --role relay' "
                       "prints at the host."
                     : "This link is for a relay: give it to 'theatron relay'."));
    if (hello.records && !may(judged.role, Right::record))
        return refuse_entry({TextCode::observer_records});
    const bool waits = judged.entry == Membership::Entry::waits;
    if (waits)
        admission_.find_door_place(hello, verdict);
    if (!verdict.refusal.empty())
        return refuse_entry(verdict.refusal);
    for (const Admission::Replaced& replaced : verdict.replaced)
        make_way(replaced);
    Participant& participant = *admission_.find(id);
    admission_.note(participant, hello, verdict);
    participant.role = judged.role;
    participant.muted = judged.muted;
    participant.admitted = judged.admitted;
    if (has_ended_)
        begin_again(participant.name);
    if (!waits) {
        enter(id, hello);
        return tell_of_own_id(id);
    }
    participant.asked = hello;
    audit(AuditEvent::What::waits, id);
    send(id, wire::Waiting{config_.name});
    tell_operators();
    tell_of_own_id(id);
}

void HostSession::make_way(const Admission::Replaced& replaced) {
    if (!replaced.told.empty())
        return refuse(replaced.id, replaced.told);
    const bool has_waited = admission_.find(replaced.id)->waits();
    leave_everything(replaced.id, Removal::interrupted);
    actions_.push_back(action::Drop{replaced.id, "its program has come back"});
    if (has_waited)
        tell_operators();
}

// `hello` was judged; it is a copy where the participant has waited.
void HostSession::enter(ParticipantId id, const wire::Join& hello) {
    Participant& participant = *admission_.find(id);
    Admission::admit(participant, hello);
    // A recording is of the present.
    if (!look_back_.is_possible() || hello.records || participant.has(wire::Feature::sends_only))
        std::erase(participant.features, wire::Feature::look_back);
    // Unseen by the others, only those who manage the session see the room.
    if (participant.has(wire::Feature::sends_only) && !participant.may(Right::manage))
        std::erase(participant.features, wire::Feature::room);
    // A recorder gets every frame, and one that only sends gets none.
    if (!relays_.is_possible() || hello.records || participant.has(wire::Feature::sends_only))
        std::erase(participant.features, wire::Feature::relay);
    if (participant.has(wire::Feature::relay))
        relays_.join(id, now_);
    actions_.push_back(action::Joined{id, participant.name, participant.person});
    audit(AuditEvent::What::joined, id, "", hello.records ? "records" : "");
    describe_session(id);
    if (hello.records)
        actions_.push_back(action::KeepEverything{id});
    if (!participant.has(wire::Feature::sends_only)) {
        streams_.join(id,
                      {checked(config_.check_depth, hello.depth_codec).codec,
                       checked(config_.check_color, hello.color_codec).codec},
                      hello.records, participant.has(wire::Feature::webcam),
                      relays_.is_reached(id));
        streams_.set_goal(id, {hello.target_latency_ms, hello.max_kbit_per_s});
    }
    renderers_.tell(id);
    // A program that only sends cameras is nobody in the room.
    if (!participant.has(wire::Feature::sends_only))
        room_.join(id, facts_of(participant), participant.has(wire::Feature::room),
                   participant.connected, participant.person, participant.link);
    else if (participant.has(wire::Feature::room))
        room_.watch(id);
    tell_playback(id);
    cases_.tell_changes();
    faces_.tell_all(id);
    chat_.join(id);
    if (participant.may(Right::manage))
        tell_operators();
}

void HostSession::describe_session(ParticipantId id) {
    const Participant& participant = *admission_.find(id);
    const bool sends_only = participant.has(wire::Feature::sends_only);
    const bool takes_faces = participant.has(wire::Feature::webcam);
    send(id, wire::Welcome{participant.protocol, id, config_.name,
                           sends_only ? std::vector<wire::Camera>()
                                      : streams_.cameras().seen_by(id, takes_faces),
                           participant.features, config_.session});
    tell_standing(id);
    if (sends_only)
        return;
    for (const wire::CameraState& state : streams_.cameras().states_seen_by(id, takes_faces))
        send(id, state);
}

}  // namespace theatron::session
