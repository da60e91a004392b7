// SPDX-License-Identifier: Apache-2.0
// The cases that can be opened in a session, and the patient of the open one. Those who may open
// cases are told of all and get the content of all; the others those of the case that the room
// shows. The patient is told to those who may know it, of another case only when they ask. Nobody
// else learns anything.
//
// A pure state machine; `admission`, `room` and `actions` must outlive it.
#pragma once

#include <map>
#include <optional>
#include <set>
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

    // The hashes of all content of each case, its description's, too; by case.
    using Content = std::map<ContentHash, std::set<ContentHash>>;
    // The cases from now on, in this order, and their patients, as far as they are known.
    void set(std::vector<CaseFacts> cases, std::vector<wire::Patient> patients, Content content);
    // Tells each participant what has changed for it: call it after each change of the room, of a
    // role, or of those who are here.
    void tell_changes();
    // The participant may not have got the newest messages.
    void tell_again(ParticipantId participant);
    // Answers whose case this offered one is; without texts to a participant who may not know it.
    void tell_asked_patient(ParticipantId participant, const Bytes& of_case);
    // The participant may have this content, as far as there is such content.
    bool may_have(ParticipantId participant, const ContentHash& content) const;

private:
    void tell_cases();
    void tell_patient();
    bool may_know(const Admission::Participant& person) const;
    // Empty: not known.
    wire::Patient patient_of(const std::optional<ContentHash>& of_case) const;

    const std::vector<Role> roles_;
    Admission& admission_;
    HostRoom& room_;
    std::vector<Action>& actions_;
    std::vector<wire::Patient> patients_;
    Content content_;
    // The lists for those who may open them and for the others, with the numbers of their changes.
    struct Told {
        wire::OfferedCases offer;
        std::uint64_t changes = 0;
    };
    Told all_, shown_;
};

}  // namespace theatron::session
