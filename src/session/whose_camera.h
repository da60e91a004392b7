// SPDX-License-Identifier: Apache-2.0
// The name under which a camera is shown: with the person whose it is, so that nobody takes a
// participant's camera for one of the operating room.
//
// Pure functions.
#pragma once

#include <string>

#include "session/room_object.h"
#include "wire/control.h"

namespace theatron::session {

// "Ben: webcam" for a camera of a participant of this room; the name alone for one of the host.
// "#7: webcam" where the room does not know the participant's name.
std::string whose_camera(const wire::Camera& camera, const RoomObjects& room);
// The same of a publisher whose name is known; empty: it is not.
std::string whose_camera(const std::string& camera, ParticipantId publisher,
                         const std::string& publisher_name);

}  // namespace theatron::session
