// SPDX-License-Identifier: Apache-2.0
// Requests on cameras: which codecs and how much of them, adjusting, playing, looking back,
// sharing.
#include <algorithm>
#include <utility>

#include "session/host_session.h"
#include "wire/no_codec.h"

namespace theatron::session {
using wire::ManageRefusal;

HostSession::CheckedCodec HostSession::checked(const CheckCodec& check, const std::string& codec) {
    return codec == wire::no_codec ? CheckedCodec{codec, ""} : check(codec);
}

void HostSession::carry_out(ParticipantId id, const wire::ChooseCodecs& wish, TimePoint) {
    if (studies_.is_locked(id))
        return send(id, wire::Settings{{}, {wire::TextCode::codecs_are_set}});
    CheckedCodec depth, color;
    if (!wish.depth_codec.empty())
        depth = checked(config_.check_depth, wish.depth_codec);
    if (!wish.color_codec.empty())
        color = checked(config_.check_color, wish.color_codec);
    for (const std::string& problem : {depth.problem, color.problem})
        if (!problem.empty())  // the old codecs stay
            return send(id, wire::Settings{{}, wire::as_written(problem)});
    streams_.fix(id, {});  // of a condition that is not locked
    streams_.choose(id, {depth.codec, color.codec}, wish.cameras);
}

void HostSession::carry_out(ParticipantId id, const wire::RequestKey& lost, TimePoint now) {
    if (!relays_.is_by_relay(id, lost.setting) ||
        relays_.may_request_key(lost.stream, lost.setting, now))
        streams_.request_key(id, lost.stream, lost.setting);
}

void HostSession::carry_out(ParticipantId id, const wire::ChooseDelivery& goal, TimePoint) {
    if (studies_.is_locked(id))
        return send(id, wire::Settings{{}, {wire::TextCode::codecs_are_set}});
    streams_.set_goal(id, goal);
}

void HostSession::carry_out_late(ParticipantId id, Participant& participant, TimePoint now) {
    RequestBudget& budget = participant.budget;
    if (!participant.late_codecs.empty() && budget.grant_later(RequestBudget::Kind::codecs, now))
        for (const auto& [camera, wish] : std::exchange(participant.late_codecs, {}))
            if (!wish.depth_codec.empty() || !wish.color_codec.empty())
                carry_out(id, wish, now);
    if (participant.late_goal && budget.grant_later(RequestBudget::Kind::delivery, now))
        carry_out(id, *std::exchange(participant.late_goal, std::nullopt), now);
}

void HostSession::carry_out(ParticipantId id, const wire::Publish& offer, TimePoint now) {
    const Participant& publisher = *admission_.find(id);
    if (!link_budgets_.offer(publisher.link, publisher.person, offer.cameras.size(), now))
        return send(id, wire::Published{{}, {wire::TextCode::offered_too_often}});
    shared_.publish(id, offer);
}

void HostSession::carry_out(ParticipantId id, const wire::Unpublish& left, TimePoint) {
    shared_.unpublish(id, left);
}

void HostSession::carry_out(ParticipantId id, const wire::CameraState& state, TimePoint) {
    shared_.on_state(id, state);
}

void HostSession::carry_out(ParticipantId id, const wire::OfferRelay& offer, TimePoint) {
    relays_.offer(id, offer);
}

// A relay speaks of its own receivers alone.
void HostSession::carry_out(ParticipantId id, const wire::RelayReport& report, TimePoint now) {
    for (const wire::RelayLink& link : report.links)
        if (relays_.relay_of(link.participant) == id && relays_.is_reached(link.participant))
            streams_.on_link(link.participant,
                             {link.kbit_per_s * 125.0, link.round_trip, link.delay,
                              int(std::min<std::uint32_t>(link.dropped, 1000)), link.takes_nothing},
                             now);
    for (const wire::RequestKey& key : report.keys)
        if (relays_.is_relay(id) && relays_.may_request_key(key.stream, key.setting, now))
            streams_.request_key(key.stream, key.setting);
}

void HostSession::carry_out(ParticipantId id, const wire::AdjustCamera& wish, TimePoint now) {
    const auto adjustment = decode_adjustment(wish.adjustment);
    const ManageRefusal refusal =
        adjustment ? adjusting_.adjust(wish.camera, *adjustment, admission_.find(id)->name, now)
                   : ManageRefusal::beyond_limits;
    send(id, wire::Managed{wish.number, refusal});
}

void HostSession::carry_out(ParticipantId id, const wire::Play& wish, TimePoint) {
    if (playback_)
        actions_.push_back(action::Play{wish.action,
                                        std::clamp(wish.position, Duration(0), playback_->length),
                                        admission_.find(id)->name});
    send(id, wire::Managed{wish.number,
                           playback_ ? ManageRefusal::none : ManageRefusal::nothing_to_play});
}

void HostSession::carry_out(ParticipantId id, const wire::LookBack& wish, TimePoint now) {
    const Participant& person = *admission_.find(id);
    Duration ago = wish.ago;
    // Those who had to ask see nothing of the time before they were let in.
    if (person.admitted)
        ago = std::min(ago, now - *person.admitted - Past::key_every);
    const bool may = person.has(wire::Feature::look_back) &&
                     (wish.ago < LookBacks::least || ago >= LookBacks::least);
    send(id, wire::Managed{wish.number,
                           may ? look_back_.begin(id, ago, now) : ManageRefusal::nothing_kept});
}

void HostSession::set_playback(const wire::Playback& playback) {
    playback_ = playback;
    for (const auto& [id, participant] : admission_.participants())
        if (participant.takes_part())
            tell_playback(id);
}

void HostSession::tell_playback(ParticipantId id) {
    if (playback_ && admission_.find(id)->has(wire::Feature::playback))
        send(id, *playback_);
}

// In the same step as the change, so that a receiver that was removed gets nothing more.
void HostSession::follow_relays() {
    const bool have_streams_changed =
        std::exchange(streams_seen_, streams_.changes()) != streams_.changes();
    if ((!relays_.take_change() && !have_streams_changed) || !relays_.is_used())
        return;
    for (const KeyRequests::Key& key : relays_.follow(streams_.uses(), now_))
        streams_.request_key(key.stream, key.setting);
    for (const auto& [id, participant] : admission_.participants())
        if (participant.has(wire::Feature::relay))
            streams_.set_by_relay(id, relays_.is_reached(id));
}

}  // namespace theatron::session
