// SPDX-License-Identifier: Apache-2.0
// Objects of the room as text for figures and scripts.
#pragma once

#include <string>

#include "session/room_object.h"

namespace theatron::session {

// "person", "brick", "organ", "screen" or "mark".
const char* text_of(ObjectKind kind);
// The hash of the objects' state: 16 hexadecimal digits, equal for equal states.
std::string hash_text(const RoomObjects& objects);

}  // namespace theatron::session
