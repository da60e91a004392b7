// SPDX-License-Identifier: Apache-2.0
#include "session/link_budgets.h"

namespace theatron::session {

LinkBudgets::Answer LinkBudgets::join(const std::string& name, const Bytes& person, TimePoint now) {
    Link& link = links_[name];
    const auto* known = link.people.find(person);
    if (known && known->facts.kept_out_until && now < *known->facts.kept_out_until)
        return Answer::after_flood;
    const bool comes_back = !person.empty() && known && now - known->seen <= remembered;
    if (!comes_back) {
        if (!link.newcomers.take(now))
            return Answer::too_often;
        link.people.note(person, now) = {.came = now};
        return Answer::granted;
    }
    Person& own = link.people.note(person, now);
    TokenBucket& shared = own.has_settled ? link.settled : link.returns;
    if (!own.returns.take(now) || !shared.take(now))
        return Answer::too_often;
    own.came = now;
    return Answer::granted;
}

bool LinkBudgets::offer(const std::string& name, const Bytes& person, std::size_t cameras,
                        TimePoint now) {
    Link& link = links_[name];
    Person& own = link.people.note(person, now);
    return (person.empty() || own.offers.take(now, double(cameras))) &&
           link.offers.take(now, double(cameras));
}

void LinkBudgets::note_flood(const std::string& name, const Bytes& person, TimePoint now) {
    Link& link = links_[name];
    link.people.note(person, now).kept_out_until = now + flood_pause;
    link.newcomers.owe(flood_cost, now);
}

void LinkBudgets::note_here(const std::string& link, const Bytes& person, TimePoint now) {
    Person& own = links_[link].people.note(person, now);
    if (own.came == TimePoint{})
        own.came = now;
    own.has_settled = own.has_settled || (!person.empty() && now - own.came >= settles_after);
}

}  // namespace theatron::session
