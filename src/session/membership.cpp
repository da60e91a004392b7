// SPDX-License-Identifier: Apache-2.0
#include "session/membership.h"

#include <algorithm>

namespace theatron::session {

Bytes shown_person(const Bytes& person) {
    constexpr std::size_t shown_bytes = 4;
    return {person.begin(), person.begin() + std::ptrdiff_t(std::min(person.size(), shown_bytes))};
}

const Membership::Known* Membership::find(const Bytes& person) const {
    const auto found = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& known) { return known.person == person; });
    return found == known_.end() ? nullptr : &*found;
}

Membership::Known* Membership::note(const Bytes& person) {
    if (person.empty())
        return nullptr;
    if (const Known* known = find(person))
        return const_cast<Known*>(known);
    if (known_.size() >= max_known_people)
        known_.pop_front();
    known_.emplace_back().person = person;
    return &known_.back();
}

Membership::Judged Membership::judge(const Bytes& person, Role of_link, bool records) const {
    const bool must_ask = asks_ && (of_link == Role::expert || of_link == Role::observer);
    Judged judged{must_ask ? Entry::waits : Entry::enters, of_link, false, {}};
    const Known* known = person.empty() ? nullptr : find(person);
    if (!known)
        return judged;
    if (known->admitted && must_ask && (!records || known->may_record)) {
        judged.entry = Entry::enters;
        judged.admitted = known->admitted;
    }
    if (known->removed)
        judged.entry = Entry::was_removed;
    if (const auto role = known->roles.find(of_link); role != known->roles.end())
        judged.role = role->second;
    judged.muted = known->muted;
    return judged;
}

void Membership::admit(const Bytes& person, bool records, TimePoint now) {
    if (Known* known = note(person)) {
        known->admitted = known->admitted.value_or(now);
        known->may_record |= records;
        known->removed = false;
    }
}

void Membership::remove(const Bytes& person, const std::string& token) {
    if (Known* known = note(person)) {
        known->removed = true;
        known->token = token;
    }
}

void Membership::remove_by(const Bytes& person, const std::string& token) {
    Known* known = note(person);
    if (known && known->removed_by.size() < max_links_kept_out)
        known->removed_by.insert(token);
}

bool Membership::is_removed_by(const Bytes& person, const std::string& token) const {
    const Known* known = find(person);
    return known && known->removed_by.contains(token);
}

std::vector<std::string> Membership::tokens_of_removed() const {
    std::vector<std::string> tokens;
    for (const Known& known : known_)
        if (known.removed)
            tokens.push_back(known.token);
    return tokens;
}

void Membership::set_muted(const Bytes& person, bool muted) {
    if (Known* known = note(person))
        known->muted = muted;
}

void Membership::set_role(const Bytes& person, Role of_link, Role role) {
    if (Known* known = note(person))
        known->roles[of_link] = role;
}

}  // namespace theatron::session
