// SPDX-License-Identifier: Apache-2.0
#include "session/room_text.h"

#include <cstdio>

namespace theatron::session {

const char* text_of(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::person:
            return "person";
        case ObjectKind::brick:
            return "brick";
        case ObjectKind::organ:
            return "organ";
        case ObjectKind::screen:
            return "screen";
        case ObjectKind::mark:
            return "mark";
    }
    return "unknown";
}

std::string hash_text(const RoomObjects& objects) {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash_of(objects)));
    return text;
}

}  // namespace theatron::session
