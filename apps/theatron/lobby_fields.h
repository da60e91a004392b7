// SPDX-License-Identifier: Apache-2.0
// Texts on a lobby that a host has sent.
#pragma once

#include "files/json_fields.h"

namespace theatron::app {

using files::is_field_set, files::text_field;

// The reason why a lobby with "held_back" names nobody.
inline constexpr const char* held_back =
    "Somebody who came by this link was removed, so it does not show who is there.";

}  // namespace theatron::app
