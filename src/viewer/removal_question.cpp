// SPDX-License-Identifier: Apache-2.0
#include "viewer/removal_question.h"

#include "wire/clear_objects.h"

namespace theatron::viewer {

std::optional<Decide> RemovalQuestion::asked(TimePoint now) const {
    return now - pressed_at_ < time_to_confirm ? pressed_ : std::nullopt;
}

bool RemovalQuestion::is_meant(const Decide& decision, TimePoint now) {
    const bool removes =
        decision.action == wire::ManageAction::remove || decision.action == wire::clear_objects;
    if (!removes)
        return true;
    if (asked(now) == decision) {
        pressed_.reset();
        return true;
    }
    pressed_ = decision;
    pressed_at_ = now;
    return false;
}

}  // namespace theatron::viewer
