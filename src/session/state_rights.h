// SPDX-License-Identifier: Apache-2.0
// The rights that the states of a participant need, for each topic. Pure.
#pragma once

#include <optional>

#include "base/bytes.h"
#include "session/permissions.h"
#include "wire/envelope.h"

namespace theatron::session {

// The right that a participant needs to send all of this state; nullopt: none. States of objects
// are judged by the room, which knows who holds them.
std::optional<Right> needed_right(const wire::State& state);

// The body of what is left of the state, for this time, for a participant without that right: of a
// pose the head, of an expression that there is none. Empty for a damaged state.
Bytes without_right(const wire::State& state, TimePoint time);

}  // namespace theatron::session
