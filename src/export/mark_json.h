// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "session/mark.h"

namespace theatron::exporting {

// A mark as `theatron export --room` writes it (docs/formats/mark.md).
nlohmann::json mark_json(const session::Mark& mark);

}  // namespace theatron::exporting
