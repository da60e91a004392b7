// SPDX-License-Identifier: Apache-2.0
// Studies with people on the host: which operator's program leads whom, the step that each
// participant is shown, and replies on their way back. The host keeps no reply.
//
// A pure state machine; `admission` and `actions` must outlive it.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "session/admission.h"
#include "session/host_actions.h"

namespace theatron::session {

class Studies {
public:
    Studies(Admission& admission, std::vector<Action>& actions)
        : admission_(admission), actions_(actions) {}

    // The leader may manage. Its first step makes it the leader of this participant, until it
    // leaves or shows a step of kind `over`.
    wire::ManageRefusal show(ParticipantId leader, const wire::ShowStudy& message);
    // Why this operator may not set what the participant sees; none: it may.
    wire::ManageRefusal judge(ParticipantId leader, ParticipantId participant) const;
    // Goes to the leader alone; one for another step than the shown one goes nowhere.
    void reply(ParticipantId participant, const wire::StudyReply& reply);

    // The participant, or the leader: those whom it led are told that the study is interrupted.
    void leave(ParticipantId id);
    void end_leading(ParticipantId leader);
    // Shows the participant its step again.
    void tell_again(ParticipantId participant);

    // While it has one, the participant chooses no codecs.
    void lock(ParticipantId participant, bool locked);
    bool is_locked(ParticipantId participant) const { return locked_.contains(participant); }

private:
    struct Run {
        ParticipantId leader{};  // {}: interrupted
        wire::StudyStep step;
    };

    Admission& admission_;
    std::vector<Action>& actions_;
    std::map<ParticipantId, Run> runs_;  // by participant
    std::set<ParticipantId> locked_;
};

}  // namespace theatron::session
