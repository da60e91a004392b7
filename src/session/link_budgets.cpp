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
        (void)link.people.note(person, now);
        return Answer::granted;
    }
    Person& own = link.people.note(person, now);
    return own.returns.take(now) && link.returns.take(now) ? Answer::granted : Answer::too_often;
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
    (void)links_[link].people.note(person, now);
}

}  // namespace theatron::session
