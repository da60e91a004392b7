// SPDX-License-Identifier: Apache-2.0
#include "session/audit_budget.h"

namespace theatron::session {

bool AuditBudget::take(const std::string& name, const Bytes& person, TimePoint now) {
    Link& link = links_[name];
    const bool is_first = !link.people.find(person);
    TokenBucket& own = link.people.note(person, now).lines;
    if (is_first) {
        (void)own.take(now);
        link.lines.owe(1, now);
        return true;
    }
    return own.take(now) && link.lines.take(now);
}

}  // namespace theatron::session
