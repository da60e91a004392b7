// SPDX-License-Identifier: Apache-2.0
// Facts of the messages that participants send to a host.
#pragma once

#include <cstdint>

#include "session/permissions.h"
#include "session/request_budget.h"
#include "wire/control.h"

namespace theatron::session {

// The limit (request_budget.h) that a message counts for.
RequestBudget::Kind kind_of(const wire::ToHost& message);

// The right that the sender needs.
Right right_needed_for(const wire::ToHost& message);

// The number of a decision that is answered with Managed; 0: it is none.
std::uint32_t decision_number(const wire::ToHost& message);

}  // namespace theatron::session
