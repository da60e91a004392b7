// SPDX-License-Identifier: Apache-2.0
// The decisions of operators on people, for one session: who was admitted or removed, who is
// muted, who has another role than that of the link. They hold when a person comes again.
//
// A pure state machine. A person is told from others by the id of its program (wire::Join::person);
// nothing is remembered of a person without one.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/time.h"
#include "session/permissions.h"

namespace theatron::session {

// The bytes of a person's id that others may read: enough to tell people apart, too few to pass for
// one of them.
Bytes shown_person(const Bytes& person);

class Membership {
public:
    // People that are remembered; beyond that the oldest is forgotten.
    static constexpr std::size_t max_known_people = 1024;

    // Links by which one person is kept out, see remove_by(); further ones are not.
    static constexpr std::size_t max_links_kept_out = 16;

    // `asks`: experts and observers wait until an operator admits them.
    explicit Membership(bool asks) : asks_(asks) {}

    enum class Entry : std::uint8_t { enters, waits, was_removed };
    struct Judged {
        Entry entry{};
        Role role{};
        bool muted = false;
        // When an operator let the person in; empty: it needed no one's permission, or waits.
        std::optional<TimePoint> admitted;
    };
    // Someone comes by a link of the role `of_link`; `records`: to record the session, for which a
    // person must be admitted apart.
    Judged judge(const Bytes& person, Role of_link, bool records = false) const;

    void admit(const Bytes& person, bool records, TimePoint now);
    // `token`: of the link by which the person came.
    void remove(const Bytes& person, const std::string& token);
    // Keeps out whoever comes as this person by this link, and nobody by another one.
    void remove_by(const Bytes& person, const std::string& token);
    bool is_removed_by(const Bytes& person, const std::string& token) const;
    void set_muted(const Bytes& person, bool muted);
    // Holds only if the person comes by a link of the same role again; by one of another role
    // somebody has another task, such as to publish, and another decision.
    void set_role(const Bytes& person, Role of_link, Role role);
    void forget_all() { known_.clear(); }

    // The tokens of links by which those came who were removed.
    std::vector<std::string> tokens_of_removed() const;

private:
    struct Known {
        Bytes person;
        std::optional<TimePoint> admitted;
        bool may_record = false;  // admitted as a recorder
        bool removed = false, muted = false;
        std::map<Role, Role> roles;  // by that of the link
        std::string token;           // of a removed one
        std::set<std::string> removed_by;
    };
    const Known* find(const Bytes& person) const;
    // Null for a person without an id.
    Known* note(const Bytes& person);

    bool asks_;
    std::deque<Known> known_;
};

}  // namespace theatron::session
