// SPDX-License-Identifier: Apache-2.0
// The decision of an operator to remove what a participant, who may have left, and its person have
// made in the room; of participant 0: what people made of whom the host does not know any more who
// they were.
#pragma once

#include "wire/to_host.h"

namespace theatron::wire {

inline constexpr ManageAction clear_objects{9};

}  // namespace theatron::wire
