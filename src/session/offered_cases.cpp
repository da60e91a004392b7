// SPDX-License-Identifier: Apache-2.0
#include "session/offered_cases.h"

#include <algorithm>
#include <utility>

namespace theatron::session {

void OfferedCases::set(std::vector<CaseFacts> cases, std::vector<wire::Patient> patients,
                       Content content) {
    room_.set_cases(std::move(cases));
    patients_ = std::move(patients);
    content_ = std::move(content);
    tell_changes();
}

void OfferedCases::tell_changes() {
    tell_cases();
    tell_patient();
}

void OfferedCases::tell_cases() {
    const std::set<ContentHash> shown = room_.shown_cases();
    wire::OfferedCases of_all, of_shown;
    for (const CaseFacts& facts : room_.cases()) {
        const wire::OfferedCase offered{Bytes(facts.id.bytes.begin(), facts.id.bytes.end()),
                                        facts.name, facts.bytes};
        of_all.cases.push_back(offered);
        if (shown.contains(facts.id))
            of_shown.cases.push_back(offered);
    }
    for (const auto& [told, now] : {std::pair(&all_, &of_all), std::pair(&shown_, &of_shown)})
        if (told->offer.cases != now->cases) {
            told->offer = std::move(*now);
            ++told->changes;
        }
    for (auto& [id, person] : admission_.participants()) {
        if (!person.takes_part() || !person.has(wire::Feature::cases))
            continue;
        const bool may_open = person.may(Right::handle);
        const Told& now = may_open ? all_ : shown_;
        const std::pair newest(may_open, now.changes);
        const bool knows_none = person.cases == Admission::Participant::no_cases;
        if (person.cases == newest || (knows_none && now.offer.cases.empty()))
            continue;
        person.cases = newest;
        actions_.push_back(action::Send{id, now.offer});
    }
}

bool OfferedCases::may_have(ParticipantId id, const ContentHash& content) const {
    if (admission_.find(id)->may(Right::handle))
        return true;
    const std::set<ContentHash> shown = room_.shown_cases();
    return std::any_of(content_.begin(), content_.end(), [&](const auto& of_case) {
        return shown.contains(of_case.first) && of_case.second.contains(content);
    });
}

bool OfferedCases::may_know(const Admission::Participant& person) const {
    return may_know_patient(person.role) && !person.records &&
           std::find(roles_.begin(), roles_.end(), person.role) != roles_.end();
}

wire::Patient OfferedCases::patient_of(const std::optional<ContentHash>& of_case) const {
    const auto found = std::find_if(patients_.begin(), patients_.end(), [&](const auto& patient) {
        return of_case && to_content_hash(patient.of_case) == of_case;
    });
    return found == patients_.end() ? wire::Patient{} : *found;
}

void OfferedCases::tell_patient() {
    const wire::Patient known = patient_of(room_.open_case());
    for (auto& [id, person] : admission_.participants()) {
        if (!person.takes_part() || !person.has(wire::Feature::patient))
            continue;
        const wire::Patient now = may_know(person) ? known : wire::Patient{};
        if (person.patient == now)
            continue;
        person.patient = now;
        actions_.push_back(action::Send{id, now});
    }
}

void OfferedCases::tell_asked_patient(ParticipantId id, const Bytes& of_case) {
    const Admission::Participant& person = *admission_.find(id);
    if (!person.has(wire::Feature::asks_patient))
        return;
    wire::Patient patient;
    if (may_know(person))
        patient = patient_of(to_content_hash(of_case));
    patient.of_case = of_case;
    actions_.push_back(action::Send{id, wire::AskedPatient{std::move(patient)}});
}

void OfferedCases::tell_again(ParticipantId id) {
    admission_.find(id)->patient.reset();
    admission_.find(id)->cases.reset();
    tell_changes();
}

}  // namespace theatron::session
