// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "wire/control.h"

namespace theatron::wire {

// "live", "stale", "ended" or "failed".
const char* text_of(CameraCondition condition);

}  // namespace theatron::wire
