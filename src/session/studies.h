// SPDX-License-Identifier: Apache-2.0
// Studies with people on the host: which operator's program leads whom, the step that each
// participant is shown, and replies on their way back. The host keeps no reply.
//
// A pure state machine; `admission` and `actions` must outlive it.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "session/admission.h"
#include "session/host_actions.h"

namespace theatron::session {

class Studies {
public:
    Studies(Admission& admission, std::vector<Action>& actions)
        : admission_(admission), actions_(actions) {}

    // The leader may manage. Its first step or condition makes it the leader of this participant,
    // until it leaves or shows a step of kind `over`.
    wire::ManageRefusal show(ParticipantId leader, const wire::ShowStudy& message, TimePoint now);
    // Why this operator may not lead this participant; none: it may. A program that is known by its
    // own person leads one person: whoever else comes is no_such_participant to it.
    wire::ManageRefusal judge(ParticipantId leader, ParticipantId participant) const;
    // After judge(): the leader sets a condition, or the usual one again.
    void claim(ParticipantId leader, ParticipantId participant, bool has_condition);
    // Goes to the leader alone; one for another step than the shown one goes nowhere.
    void reply(ParticipantId participant, const wire::StudyReply& reply);

    // The participant leaves.
    void leave(ParticipantId participant);
    // Tells those whom it led that the study is interrupted. Returns those of them who have a
    // condition, which ends.
    std::vector<ParticipantId> end_leading(ParticipantId leader);
    // Shows the participant its step again, with what is left of its times.
    void tell_again(ParticipantId participant);
    void on_tick(TimePoint now) { now_ = now; }

    // While it has one, the participant chooses no codecs.
    void lock(ParticipantId participant, bool locked);
    bool is_locked(ParticipantId participant) const { return locked_.contains(participant); }

private:
    // Leaders whose person is remembered; more than operators in a session.
    static constexpr std::size_t max_remembered = 64;

    void take_lead(ParticipantId leader, ParticipantId participant);

    struct Run {
        ParticipantId leader{};               // {}: interrupted
        std::optional<wire::StudyStep> step;  // none: a condition alone
        TimePoint shown;
        bool has_condition = false;
    };

    Admission& admission_;
    std::vector<Action>& actions_;
    std::map<ParticipantId, Run> runs_;  // by participant
    std::set<ParticipantId> locked_;
    std::map<Bytes, Bytes> led_;  // persons (wire::Join), by those of their leaders
    TimePoint now_;               // at the last tick
};

}  // namespace theatron::session
