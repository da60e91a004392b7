// SPDX-License-Identifier: Apache-2.0
#include "session/host_session.h"

#include <algorithm>
#include <utility>

#include "session/request_kinds.h"

namespace theatron::session {
namespace {

constexpr Duration renderer_interval = std::chrono::seconds(1);
constexpr Duration note_interval = std::chrono::seconds(1);
using Kind = RequestBudget::Kind;
using wire::TextCode;

}  // namespace

HostSession::HostSession(Config config)
    : config_(std::move(config)),
      admission_(config_.admission),
      membership_(config_.admission.asks),
      streams_(config_.streams, actions_),
      look_back_(config_.past, streams_, actions_),
      relays_(config_.make_secret, actions_),
      room_(config_.room, actions_, config_.authors),
      shared_(config_.session, admission_, streams_, room_, look_back_, actions_),
      adjusting_(streams_, look_back_, actions_),
      renderers_(admission_, actions_),
      cases_(config_.patient_for, admission_, room_, actions_),
      faces_(config_.make_digest, admission_, actions_),
      studies_(admission_, actions_),
      chat_(admission_, actions_) {
    std::vector<wire::Camera> own = config_.cameras;
    int number = 0;
    for (wire::Camera& camera : own) {
        while (config_.absent.contains(CameraId(number)))
            ++number;
        camera.id = CameraId(number++);
    }
    shared_.keep_numbers(int(own.size() + config_.absent.size()));
    shared_.add_own(std::move(own));
}

void HostSession::on_connected(ParticipantId id, TimePoint now, const std::string& address) {
    relays_.set_address(id, address);
    admission_.on_connected(id, 2 * streams_.cameras().size(), now);
}

void HostSession::on_control(ParticipantId id, ByteView bytes, TimePoint now) {
    Participant* participant = admission_.find(id);
    if (!participant || participant->closing)
        return;
    participant->heard = now_ = now;
    auto message = wire::decode_to_host(bytes);
    // A newer participant may send messages that this host does not know.
    if (!message && message.error() != Status::unsupported)
        return refuse(id, {TextCode::damaged_message, {std::string(to_text(message.error()))}});
    if (message && !participant->joined && !participant->waits()) {
        const auto* hello = std::get_if<wire::Join>(&*message);
        return hello ? join(id, *hello, now) : refuse(id, {TextCode::not_joined});
    }
    const Kind kind = message ? kind_of(*message) : Kind::other;
    switch (participant->budget.ask(kind, now)) {
        case RequestBudget::Answer::granted:
            // By the answer those who wait know that the connection has not frozen.
            if (message && kind == Kind::ping && participant->waits())
                carry_out(id, std::get<wire::Ping>(*message), now);
            else if (message && !participant->may(right_needed_for(*message)))
                deny(id, *message);
            else if (message)
                std::visit([&](const auto& m) { carry_out(id, m, now); }, *message);
            break;
        case RequestBudget::Answer::too_often:
            if (message && std::holds_alternative<wire::Publish>(*message))
                send(id, wire::Published{{}, {TextCode::offered_too_often}});
            else if (message && std::holds_alternative<wire::Unpublish>(*message))
                carry_out(id, std::get<wire::Unpublish>(*message), now);
            else if (message && std::holds_alternative<wire::RoomRequest>(*message))
                room_.refuse(id, std::get<wire::RoomRequest>(*message), Refusal::too_often);
            else if (message && std::holds_alternative<wire::StudyReply>(*message))
                studies_.tell_again(id);  // otherwise the participant waits for ever
            else if (message && decision_number(*message) != 0)
                send(id, wire::Managed{decision_number(*message), wire::ManageRefusal::too_often});
            else if (message)
                Admission::keep_for_later(*participant, std::move(*message));
            break;
        case RequestBudget::Answer::flood:
            end_flood(id, now);
            break;
    }
}

void HostSession::end_flood(ParticipantId id, TimePoint now) {
    const Participant* participant = admission_.find(id);
    if (!participant || participant->closing)
        return;
    link_budgets_.note_flood(participant->link, participant->person, now);
    refuse(id, {TextCode::too_many_requests});
}

void HostSession::carry_out(ParticipantId, const wire::Join&, TimePoint) {}

void HostSession::carry_out(ParticipantId id, const wire::Ping& ping, TimePoint now) {
    send(id, wire::Pong{ping.sent, now, now});
}

void HostSession::carry_out(ParticipantId id, const wire::Report& report, TimePoint now) {
    Participant& participant = *admission_.find(id);
    participant.report = report.streams;
    relays_.report(id, report.streams, now);
    // Reports repeat it; a participant that changes it all the time must not fill the log.
    if (report.renderer == participant.renderer ||
        now - participant.renderer_noted < renderer_interval)
        return;
    participant.renderer_noted = now;
    participant.renderer = report.renderer;
    actions_.push_back(action::Drawing{id, report.renderer});
}

void HostSession::carry_out(ParticipantId id, const wire::RoomRequest& request, TimePoint) {
    if (const auto ended = room_.on_request(id, request))
        shared_.end_share(*ended, id);
    cases_.tell_changes();
}

void HostSession::carry_out(ParticipantId id, const wire::RequestContent& request, TimePoint) {
    if (request.count == 0)
        return;
    const ContentHash hash = to_content_hash(request.hash).value_or(ContentHash{});
    if (faces_.content(hash) ? faces_.may_have(id) : cases_.may_have(id, hash))
        actions_.push_back(action::SendContent{id, hash, request.offset, request.count});
    else  // as of content that there is not
        send(id, wire::Content{request.hash, request.offset, 0, {}});
}

void HostSession::carry_out(ParticipantId id, const wire::AskPatient& question, TimePoint) {
    cases_.tell_asked_patient(id, question.of_case);
}

void HostSession::carry_out(ParticipantId id, const wire::VoiceConsent& consent, TimePoint) {
    Participant& person = *admission_.find(id);
    if (!person.has(wire::Feature::voice_consent) || person.voice_recorded == consent.may_record)
        return;
    person.voice_recorded = consent.may_record;
    audit(consent.may_record ? AuditEvent::What::voice_agreed : AuditEvent::What::voice_not_agreed,
          id);
    room_.set_person(id, facts_of(person));
}

void HostSession::carry_out(ParticipantId id, const wire::WriteChat& written, TimePoint now) {
    chat_.write(id, written, now);
}

void HostSession::carry_out(ParticipantId id, const wire::RaiseHand& message, TimePoint) {
    Participant& person = *admission_.find(id);
    if (!person.has(wire::Feature::chat) || person.hand_raised == message.raised)
        return;
    person.hand_raised = message.raised;
    room_.set_person(id, facts_of(person));
}

std::vector<ObjectPose> HostSession::replay_room(const RoomObjects& recorded, TimePoint now) {
    const std::uint64_t before = room_.replayed_changes();
    std::vector<ObjectPose> moved = room_.replay(recorded, now);
    if (room_.replayed_changes() != before)
        cases_.tell_changes();
    return moved;
}

HostSession::Recipients HostSession::on_media(const wire::MediaHeader& header, std::size_t size,
                                              TimePoint now) {
    return recipients(streams_.on_media(header, size, now), header, now);
}

HostSession::Recipients HostSession::on_media_from(ParticipantId id, ByteView message,
                                                   TimePoint now) {
    SharedCameras::Received received = shared_.on_media(id, message, now);
    if (!received.problem.empty())
        refuse(id, std::move(received.problem));
    if (!received.header)
        return {};
    return recipients(std::move(received.receivers), *received.header, now);
}

HostSession::Recipients HostSession::recipients(std::vector<ParticipantId> receivers,
                                                const wire::MediaHeader& header, TimePoint now) {
    now_ = now;
    if (!relays_.is_used())
        return {std::move(receivers), {}, 0};
    std::erase_if(receivers, [&](ParticipantId id) { return !relays_.goes_by_host(id, header); });
    const int layer = streams_.layer_of(header);
    return {std::move(receivers), relays_.relays_of(header, layer, now), layer};
}

void HostSession::on_link(ParticipantId id, const LinkMeasure& link, TimePoint now) {
    const Participant* participant = admission_.find(id);
    // The relay of a receiver measures the link that its pictures take.
    if (participant && participant->takes_part() && !relays_.is_reached(id))
        streams_.on_link(id, link, now);
}

void HostSession::on_closed(ParticipantId id) {
    if (Participant* participant = admission_.find(id)) {
        const bool has_waited = participant->waits();
        if (participant->joined || has_waited)
            audit(AuditEvent::What::left, id);
        if (!participant->refused_for_good && !has_ended_)
            admission_.remember(*participant);
        // A publisher that ends takes its cameras back first.
        leave_everything(id, Removal::interrupted);
        admission_.remove(id);
        if (has_waited)
            tell_operators();
    }
}

// The participant has no part in the session any more: its connection has ended or is about to.
// Every way of leaving comes by here.
void HostSession::leave_everything(ParticipantId id, Removal cameras) {
    admission_.find(id)->closing = true;
    shared_.remove_all(id, cameras);
    end_leading(id);
    studies_.leave(id);
    renderers_.forget(id);
    look_back_.leave(id);
    relays_.leave(id);
    streams_.leave(id);
    room_.leave(id);
    faces_.leave(id);
}

void HostSession::on_tick(TimePoint now) {
    const bool notes = now - noted_here_ >= note_interval;
    if (notes)
        noted_here_ = now;
    for (auto& [id, participant] : admission_.participants()) {
        if (notes && (participant.takes_part() || participant.waits()))
            link_budgets_.note_here(participant.link, participant.person, now);
        if (!participant.joined && !participant.asked && !participant.closing &&
            now - participant.connected > Admission::join_deadline)
            refuse(id, {TextCode::joined_too_late});
        if (participant.takes_part())
            carry_out_late(id, participant, now);
    }
    studies_.on_tick(now);
    adjusting_.on_tick(now);
    look_back_.on_tick(now);
    now_ = now;
    relays_.on_tick(now);
    streams_.on_tick(now);
}

void HostSession::resynchronise(ParticipantId id) {
    Participant* participant = admission_.find(id);
    if (!participant || !participant->takes_part())
        return;
    look_back_.end(id);
    describe_session(id);
    renderers_.tell(id);
    streams_.tell_again(id);
    relays_.tell_again(id);
    room_.send_snapshot(id);
    tell_playback(id);
    cases_.tell_again(id);
    studies_.tell_again(id);
    chat_.join(id);
    if (participant->may(Right::manage))
        tell_operators();
}

void HostSession::end(wire::TextCode reason) {
    look_back_.clear();
    // Nobody is told that cameras of others leave: the session ends, and a recorder notes the gap
    // if it goes on later.
    for (const auto& [id, participant] : admission_.participants())
        if (participant.takes_part())
            streams_.leave(id);
    for (auto& [id, participant] : admission_.participants()) {
        if (!participant.takes_part() && !participant.waits())
            continue;
        if (participant.waits())
            audit(AuditEvent::What::left, id);
        leave_everything(id, Removal::decided);
        actions_.push_back(action::End{id, {{reason}}});
    }
    has_ended_ = true;
}

const std::vector<ActiveSetting>& HostSession::depth_settings(CameraId camera) const {
    return streams_.settings(camera, true);
}

const std::vector<ActiveSetting>& HostSession::color_settings(CameraId camera) const {
    return streams_.settings(camera, false);
}

std::vector<Action> HostSession::take_actions() {
    follow_relays();
    return std::exchange(actions_, {});
}

void HostSession::refuse(ParticipantId id, wire::Text reason) {
    Participant& participant = *admission_.find(id);
    const bool has_waited = participant.waits();
    if (participant.joined && participant.has(wire::Feature::relay))
        relays_.renew_key();
    participant.refused_for_good = wire::is_for_good(reason.code);
    wire::Refused refusal = wire::refused(std::move(reason));
    std::string why = refusal.in_english;
    send(id, std::move(refusal));
    leave_everything(id, Removal::decided);
    actions_.push_back(action::Close{id, std::move(why)});
    if (has_waited)
        tell_operators();
}

void HostSession::send(ParticipantId id, wire::ToParticipant message) {
    actions_.push_back(action::Send{id, std::move(message)});
}

}  // namespace theatron::session
