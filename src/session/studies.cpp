// SPDX-License-Identifier: Apache-2.0
#include "session/studies.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "wire/envelope.h"

namespace theatron::session {

using wire::ManageRefusal;
using wire::StudyKind;

wire::ManageRefusal Studies::judge(ParticipantId leader, ParticipantId participant) const {
    const Admission::Participant* person = admission_.find(participant);
    if (!person || !person->takes_part())
        return ManageRefusal::no_such_participant;
    if (participant == leader)
        return ManageRefusal::yourself;
    const auto run = runs_.find(participant);
    if (run != runs_.end() && run->second.leader != ParticipantId{} && run->second.leader != leader)
        return ManageRefusal::other_study;
    const auto led = led_.find(admission_.find(leader)->person);
    if (led != led_.end() && !person->person.empty() && led->second != person->person)
        return ManageRefusal::no_such_participant;
    return ManageRefusal::none;
}

void Studies::take_lead(ParticipantId leader, ParticipantId participant) {
    runs_[participant].leader = leader;
    const Bytes& own = admission_.find(leader)->person;
    const Bytes& person = admission_.find(participant)->person;
    if (own.empty() || person.empty())
        return;
    led_[own] = person;
    if (led_.size() > max_remembered)
        led_.erase(led_.begin()->first == own ? std::next(led_.begin()) : led_.begin());
}

void Studies::claim(ParticipantId leader, ParticipantId participant, bool has_condition) {
    take_lead(leader, participant);
    Run& run = runs_[participant];
    run.has_condition = has_condition;
    if (!has_condition && !run.step)
        runs_.erase(participant);
}

wire::ManageRefusal Studies::show(ParticipantId leader, const wire::ShowStudy& message,
                                  TimePoint now) {
    if (const ManageRefusal refusal = judge(leader, message.participant);
        refusal != ManageRefusal::none)
        return refusal;
    if (!admission_.find(message.participant)->has(wire::Feature::study))
        return ManageRefusal::shows_no_study;
    // Tables of a message may share texts, which are sent on each for itself.
    if (wire::encode(wire::ToParticipant(message.step)).size() > wire::max_control_size)
        return ManageRefusal::large_step;
    actions_.push_back(action::Send{message.participant, message.step});
    if (message.step.kind == StudyKind::over) {
        runs_.erase(message.participant);
    } else {
        take_lead(leader, message.participant);
        Run& run = runs_[message.participant];
        run.step = message.step;
        run.shown = now;
    }
    return ManageRefusal::none;
}

void Studies::reply(ParticipantId participant, const wire::StudyReply& reply) {
    const auto run = runs_.find(participant);
    if (run != runs_.end() && run->second.leader != ParticipantId{} && run->second.step &&
        run->second.step->step == reply.step)
        actions_.push_back(
            action::Send{run->second.leader, wire::StudyReplied{participant, reply}});
}

void Studies::leave(ParticipantId participant) {
    runs_.erase(participant);
    locked_.erase(participant);
}

std::vector<ParticipantId> Studies::end_leading(ParticipantId leader) {
    std::vector<ParticipantId> freed;
    for (auto& [participant, run] : runs_) {
        if (run.leader != leader)
            continue;
        run.leader = {};
        if (std::exchange(run.has_condition, false))
            freed.push_back(participant);
        if (run.step)
            run.step->kind = StudyKind::interrupted;
        tell_again(participant);
    }
    std::erase_if(runs_, [](const auto& entry) {
        return entry.second.leader == ParticipantId{} && !entry.second.step;
    });
    return freed;
}

void Studies::tell_again(ParticipantId participant) {
    const auto run = runs_.find(participant);
    if (run == runs_.end() || !run->second.step)
        return;
    wire::StudyStep step = *run->second.step;
    const Duration passed = std::max(now_ - run->second.shown, Duration(0));
    for (Duration* time : {&step.watch, &step.limit})
        if (*time > Duration(0))  // 0: there is none
            *time = std::max(*time - passed, Duration(1));
    actions_.push_back(action::Send{participant, std::move(step)});
}

void Studies::lock(ParticipantId participant, bool locked) {
    if (locked)
        locked_.insert(participant);
    else
        locked_.erase(participant);
}

}  // namespace theatron::session
