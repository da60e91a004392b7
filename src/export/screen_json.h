// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "session/shared_screen.h"

namespace theatron::exporting {

// A shared screen as `theatron export --room` writes it (docs/formats/room.md).
nlohmann::json screen_json(const session::SharedScreen& screen);

}  // namespace theatron::exporting
