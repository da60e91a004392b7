// SPDX-License-Identifier: Apache-2.0
// The cases that can be opened in a session, and the patient of the open one, who is told to those
// who may know it and to nobody else.
//
// A pure state machine; `admission`, `room` and `actions` must outlive it.
#pragma once

#include <utility>
#include <vector>

#include "session/admission.h"
#include "session/host_actions.h"
#include "session/host_room.h"

namespace theatron::session {

class OfferedCases {
public:
    // `roles`: those of them that may_know_patient() are told.
    OfferedCases(std::vector<Role> roles, Admission& admission, HostRoom& room,
                 std::vector<Action>& actions)
        : roles_(std::move(roles)), admission_(admission), room_(room), actions_(actions) {}

    // The cases from now on, in this order, and their patients, as far as they are known; told to
    // all.
    void set(std::vector<CaseFacts> cases, std::vector<wire::Patient> patients);
    // Tells the participant the cases, if there are any.
    void tell(ParticipantId participant);
    // Tells those who may know it what has changed for them, and withdraws it from the others.
    void tell_patient();
    // The participant may not have got the newest message.
    void tell_patient_again(ParticipantId participant);

private:
    void send(ParticipantId participant);

    const std::vector<Role> roles_;
    Admission& admission_;
    HostRoom& room_;
    std::vector<Action>& actions_;
    std::vector<wire::Patient> patients_;
};

}  // namespace theatron::session
