// SPDX-License-Identifier: Apache-2.0
#include "viewer/removal_question.h"

namespace theatron::viewer {

std::optional<ParticipantId> RemovalQuestion::asked(TimePoint now) const {
    return now - asked_ < time_to_confirm ? person_ : std::nullopt;
}

bool RemovalQuestion::is_meant(const Decide& decision, TimePoint now) {
    if (decision.action != wire::ManageAction::remove || asked(now) == decision.person)
        return true;
    person_ = decision.person;
    asked_ = now;
    return false;
}

}  // namespace theatron::viewer
