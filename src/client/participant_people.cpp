// SPDX-License-Identifier: Apache-2.0
// A participant's role, and an operator's decisions on others.
#include <algorithm>
#include <string>
#include <utility>

#include "client/participant_shared.h"
#include "session/permissions.h"
#include "wire/sentence.h"

namespace theatron::client {
namespace {

// Answers that wait to be taken; the oldest is dropped.
constexpr std::size_t max_waiting_answers = 64;

}  // namespace

void Participant::on_waiting() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->status.phase = Phase::waiting;
        shared_->status.problem.clear();
        shared_->status.host_name = session_.waiting().host_name;
    }
    announce();
    remark(say(Phrase::you_wait));
}

void Participant::on_standing() {
    const wire::Standing& now = session_.standing();
    wire::Standing before;
    bool is_first = false;
    {
        const std::lock_guard lock(shared_->mutex);
        is_first = !std::exchange(shared_->has_standing, true);
        before = std::exchange(shared_->status.standing, now);
        if (now.role != wire::Role::operator_)
            shared_->visitors.clear();
    }
    announce();
    if (!is_first)
        follow_role(before.role, now.role);
    if (!is_first && now.role != before.role)
        remark(say(Phrase::role_is_now, wire::spoken_with_article(now.role)));
    if (now.muted != before.muted && (now.muted || !is_first))
        remark(say(now.muted ? Phrase::you_are_muted : Phrase::no_longer_muted));
}

// The host withdraws face and screen of a person whose new role does not show them.
void Participant::follow_role(wire::Role before, wire::Role now) {
    const auto follow = [&](Offer offer, session::Right right, wire::TextCode forbidden) {
        const bool may = session::may(now, right);
        if (may == session::may(before, right))
            return;
        if (may)
            return offer_cameras(offer);
        if (numbers(offer).empty())
            return;
        forget_numbers(offer);
        refuse_cameras(offer, {forbidden});
    };
    follow(Offer::face, session::Right::be_seen, wire::TextCode::face_forbidden);
    follow(Offer::screen, session::Right::show_screen, wire::TextCode::screen_forbidden);
}

void Participant::on_visitors() {
    std::vector<std::string> remarks;
    {
        const std::lock_guard lock(shared_->mutex);
        const auto before = std::exchange(shared_->visitors, session_.visitors());
        for (const wire::Visitor& visitor : session_.visitors())
            if (std::find(before.begin(), before.end(), visitor) == before.end())
                shared_->add_remark(
                    remarks, "visitors",
                    say(visitor.records ? Phrase::asks_to_record : Phrase::asks_to_come_in,
                        visitor.name, wire::spoken_with_article(visitor.role)));
    }
    announce();
    for (const std::string& text : remarks)
        remark(text);
}

void Participant::on_managed() {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->managed.size() >= max_waiting_answers)
        shared_->managed.pop_front();
    shared_->managed.push_back(session_.managed());
}

std::vector<wire::Visitor> Participant::visitors() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->visitors;
}

std::uint32_t Participant::manage(wire::ManageAction action, ParticipantId person,
                                  wire::Role role) {
    return decide(wire::Manage{0, action, person, role});
}

std::uint32_t Participant::decide(auto decision) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client || shared_->status.phase != Phase::joined)
        return 0;
    decision.number = ++shared_->decisions;
    shared_->client->post(
        [this, decision] { shared_->client->send_control(wire::encode(decision)); });
    return decision.number;
}

std::uint32_t Participant::adjust(CameraId camera, const session::CameraAdjustment& adjustment) {
    {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->may_adjust)
            return 0;
    }
    return decide(wire::AdjustCamera{0, camera, session::encode_adjustment(adjustment)});
}

std::uint32_t Participant::play(wire::PlayAction action, Duration position) {
    return playback() ? decide(wire::Play{0, action, position}) : 0;
}

void Participant::on_study() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->study = {session_.study_step(), ++shared_->study_steps};
    }
    announce();
}

void Participant::on_study_reply() {
    {
        const std::lock_guard lock(shared_->mutex);
        if (shared_->study_replies.size() >= max_waiting_answers)
            shared_->study_replies.pop_front();
        shared_->study_replies.push_back(session_.study_reply());
    }
    announce();
}

std::optional<Participant::Study> Participant::study() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->study;
}

bool Participant::reply_to_study(const wire::StudyReply& reply) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client || shared_->status.phase != Phase::joined)
        return false;
    shared_->client->post([this, reply] { shared_->client->send_control(wire::encode(reply)); });
    return true;
}

std::uint32_t Participant::show_study(ParticipantId person, const wire::StudyStep& step) {
    {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->may_lead_study)
            return 0;
    }
    return decide(wire::ShowStudy{0, person, step});
}

std::uint32_t Participant::set_condition(const wire::SetCondition& condition) {
    {
        const std::lock_guard lock(shared_->mutex);
        if (!shared_->may_lead_study)
            return 0;
    }
    return decide(wire::SetCondition(condition));
}

std::optional<wire::StudyReplied> Participant::take_study_reply() {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->study_replies.empty())
        return std::nullopt;
    const wire::StudyReplied oldest = shared_->study_replies.front();
    shared_->study_replies.pop_front();
    return oldest;
}

std::uint32_t Participant::look_back(Duration ago) {
    return can_look_back() ? decide(wire::LookBack{0, ago}) : 0;
}

bool Participant::can_look_back() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->can_look_back;
}

std::set<CameraId> Participant::past_cameras() const {
    const std::lock_guard lock(shared_->mutex);
    std::set<CameraId> cameras;
    for (const wire::StreamSetting& setting : shared_->settings)
        if (setting.past)
            cameras.insert(camera_of(setting.stream));
    return cameras;
}

void Participant::on_playback() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->playback = session_.playback();
    }
    announce();
}

void Participant::on_patient() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->patient = session_.patient();
        shared_->asked_patient = session_.asked_patient();
    }
    announce();
}

wire::Patient Participant::patient() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->patient;
}

bool Participant::ask_patient(const ContentHash& offered) {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->client || shared_->status.phase != Phase::joined || !shared_->may_ask_patient)
        return false;
    shared_->asked_patient = {};
    const wire::AskPatient question{Bytes(offered.bytes.begin(), offered.bytes.end())};
    shared_->client->post(
        [this, question] { shared_->client->send_control(wire::encode(question)); });
    return true;
}

wire::Patient Participant::asked_patient() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->asked_patient;
}

std::optional<wire::Playback> Participant::playback() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->playback;
}

std::optional<wire::Managed> Participant::take_managed() {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->managed.empty())
        return std::nullopt;
    const wire::Managed oldest = shared_->managed.front();
    shared_->managed.pop_front();
    return oldest;
}

}  // namespace theatron::client
