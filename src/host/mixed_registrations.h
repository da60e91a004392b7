// SPDX-License-Identifier: Apache-2.0
// Cameras that were placed in the room by different registrations.
#pragma once

#include <string>
#include <vector>

#include "wire/control.h"

namespace theatron::host {

// A sentence that names two of them; empty where all places come from one registration, or from
// people's hands.
std::string mixed_registrations(const std::vector<wire::Camera>& cameras);

}  // namespace theatron::host
