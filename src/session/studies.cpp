// SPDX-License-Identifier: Apache-2.0
#include "session/studies.h"

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
    return ManageRefusal::none;
}

wire::ManageRefusal Studies::show(ParticipantId leader, const wire::ShowStudy& message) {
    if (const ManageRefusal refusal = judge(leader, message.participant);
        refusal != ManageRefusal::none)
        return refusal;
    if (!admission_.find(message.participant)->has(wire::Feature::study))
        return ManageRefusal::shows_no_study;
    // Tables of a message may share texts, which are sent on each for itself.
    if (wire::encode(wire::ToParticipant(message.step)).size() > wire::max_control_size)
        return ManageRefusal::large_step;
    actions_.push_back(action::Send{message.participant, message.step});
    if (message.step.kind == StudyKind::over)
        runs_.erase(message.participant);
    else
        runs_[message.participant] = {leader, message.step};
    return ManageRefusal::none;
}

void Studies::reply(ParticipantId participant, const wire::StudyReply& reply) {
    const auto run = runs_.find(participant);
    if (run != runs_.end() && run->second.leader != ParticipantId{} &&
        run->second.step.step == reply.step)
        actions_.push_back(
            action::Send{run->second.leader, wire::StudyReplied{participant, reply}});
}

void Studies::leave(ParticipantId id) {
    runs_.erase(id);
    locked_.erase(id);
    end_leading(id);
}

void Studies::end_leading(ParticipantId leader) {
    for (auto& [participant, run] : runs_)
        if (run.leader == leader) {
            run.leader = {};
            run.step.kind = StudyKind::interrupted;
            tell_again(participant);
        }
}

void Studies::tell_again(ParticipantId participant) {
    if (const auto run = runs_.find(participant); run != runs_.end())
        actions_.push_back(action::Send{participant, run->second.step});
}

void Studies::lock(ParticipantId participant, bool locked) {
    if (locked)
        locked_.insert(participant);
    else
        locked_.erase(participant);
}

}  // namespace theatron::session
