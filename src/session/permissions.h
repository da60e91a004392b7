// SPDX-License-Identifier: Apache-2.0
// The rights of roles. The host checks every message of a participant against this table and that
// of the right that each kind of message needs (request_kinds.h).
#pragma once

#include "wire/control.h"
#include "wire/role.h"

namespace theatron::session {

using wire::Role;

enum class Right : std::uint8_t {
    see,          // receive cameras and the room, and choose how
    speak,        // taken away by muting
    point,        // show hands, call others to oneself
    handle,       // create, hold, change and remove objects
    record,       // join as a recorder
    publish,      // send cameras
    manage,       // admit, mute and remove others, change their roles, end the session
    adjust,       // nudge cameras, draw their regions
    play,         // pause and seek the recording that the host plays
    be_seen,      // send the picture of the own face, or its expression
    show_screen,  // send the pictures of a screen (wire::CameraKind::screen)
    write,        // to all others; taken away by muting
    take_part,    // ask for the session's time
    relay,        // be sent the sealed pictures of the session, for receivers that the host names
};

constexpr bool may(Role role, Right right) {
    switch (role) {
        case Role::observer:
            return right == Right::see || right == Right::write || right == Right::take_part;
        case Role::expert:
            return right != Right::publish && right != Right::manage && right != Right::adjust &&
                   right != Right::relay;
        case Role::publisher:
            return right != Right::manage && right != Right::adjust && right != Right::relay;
        case Role::operator_:
            return right != Right::relay;
        case Role::relay:
            return right == Right::take_part || right == Right::relay;
    }
    return false;
}

// Observers never learn who the patient is; a host chooses among the other roles.
constexpr bool may_know_patient(Role role) {
    return role != Role::observer && role != Role::relay;
}

// The rights of messages that depend on what they say; request_kinds.cpp has those of all.
constexpr Right needed_right(wire::CameraKind kind) {
    switch (kind) {
        case wire::CameraKind::face:
            return Right::be_seen;
        case wire::CameraKind::screen:
            return Right::show_screen;
        case wire::CameraKind::room:
        case wire::CameraKind::person:
            break;
    }
    return Right::publish;
}
// One camera of the room is enough to need the right for it, and one screen that for screens.
inline Right needed_right(const wire::Publish& message) {
    Right needed = message.cameras.empty() ? Right::publish : Right::be_seen;
    for (const wire::OfferedCamera& camera : message.cameras) {
        const Right own = needed_right(camera.kind);
        if (own == Right::publish)
            return own;
        if (own == Right::show_screen)
            needed = own;
    }
    return needed;
}
// Number 0 asks for a snapshot.
constexpr Right needed_right(const wire::RoomRequest& message) {
    return message.number == 0 ? Right::see : Right::handle;
}

}  // namespace theatron::session
