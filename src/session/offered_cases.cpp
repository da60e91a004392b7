// SPDX-License-Identifier: Apache-2.0
#include "session/offered_cases.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

void OfferedCases::set(std::vector<CaseFacts> cases, std::vector<wire::Patient> patients) {
    room_.set_cases(std::move(cases));
    patients_ = std::move(patients);
    for (const auto& [id, participant] : admission_.participants())
        if (participant.takes_part())
            send(id);
    tell_patient();
}

void OfferedCases::tell(ParticipantId id) {
    if (!room_.cases().empty())
        send(id);
}

void OfferedCases::send(ParticipantId id) {
    if (!admission_.find(id)->has(wire::Feature::cases))
        return;
    wire::OfferedCases offer;
    for (const CaseFacts& facts : room_.cases())
        offer.cases.push_back(
            {Bytes(facts.id.bytes.begin(), facts.id.bytes.end()), facts.name, facts.bytes});
    actions_.push_back(action::Send{id, std::move(offer)});
}

void OfferedCases::tell_patient() {
    const auto open = room_.open_case();
    const auto found = std::find_if(patients_.begin(), patients_.end(), [&](const auto& patient) {
        return open && to_content_hash(patient.of_case) == open;
    });
    const wire::Patient known = found == patients_.end() ? wire::Patient{} : *found;
    for (auto& [id, person] : admission_.participants()) {
        if (!person.takes_part() || !person.has(wire::Feature::patient))
            continue;
        const bool may_know = may_know_patient(person.role) && !person.records &&
                              std::find(roles_.begin(), roles_.end(), person.role) != roles_.end();
        const wire::Patient now = may_know ? known : wire::Patient{};
        if (person.patient == now)
            continue;
        person.patient = now;
        actions_.push_back(action::Send{id, now});
    }
}

void OfferedCases::tell_patient_again(ParticipantId id) {
    admission_.find(id)->patient.reset();
    tell_patient();
}

}  // namespace theatron::session
