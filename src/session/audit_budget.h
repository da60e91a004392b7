// SPDX-License-Identifier: Apache-2.0
// How many lines of the audit log are about one link and about one person who comes by it: whoever
// has a link hides nothing that others do. The first line of a person always comes. Those who know
// no link have lines of their own, few for all of them together.
//
// Pure; time is passed in.
#pragma once

#include <map>
#include <string>

#include "base/bytes.h"
#include "base/time.h"
#include "session/remembered_people.h"
#include "session/request_budget.h"

namespace theatron::session {

class AuditBudget {
public:
    static constexpr RequestBudget::Limit of_link{1, 500};
    static constexpr RequestBudget::Limit of_person{0.2, 60};
    static constexpr RequestBudget::Limit of_strangers{0.02, 60};
    // People of one link that are remembered.
    static constexpr std::size_t max_people = 1024;

    // A line is about this person, who came by this link. False: it is left out.
    bool take(const std::string& link, const Bytes& person, TimePoint now);
    // A line is about somebody who was refused without a link.
    bool take_of_stranger(TimePoint now) { return strangers_.take(now); }

private:
    struct Person {
        TokenBucket lines{of_person.per_second, of_person.at_once};
    };
    struct Link {
        TokenBucket lines{of_link.per_second, of_link.at_once};
        RememberedPeople<Person> people{max_people};
    };
    std::map<std::string, Link> links_;
    TokenBucket strangers_{of_strangers.per_second, of_strangers.at_once};
};

}  // namespace theatron::session
