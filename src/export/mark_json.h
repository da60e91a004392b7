// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "room/mark.h"

namespace theatron::exporting {

// A mark as `theatron export --room` writes it (docs/formats/mark.md).
nlohmann::json mark_json(const room::Mark& mark);

}  // namespace theatron::exporting
