// SPDX-License-Identifier: Apache-2.0
// Places in the room to which a person can go by name.
#pragma once

#include <string>
#include <vector>

#include "viewer/eye.h"

namespace theatron::viewer {

struct Place {
    std::string name;
    Pose room_from_eye;  // z forward, y down
};

// Places around the point that the registered cameras look at; empty without such a camera that
// has sent a picture.
std::vector<Place> places_of(const ViewableCameras& cameras);

// The eye high above that point, which looks straight down; the side towards the first camera is
// below. Also of cameras that are not registered; nullopt while none has sent a picture.
std::optional<Pose> from_above(const ViewableCameras& cameras);

// The eye of somebody who joins a conversation with the person at `room_from_head` (y up, -z
// forward): beside this person, with the same direction, at the nearest place to the right or left
// where nobody else is. `heads`: of the others.
Pose beside(const Pose& room_from_head, const std::vector<Vec3>& heads = {});

}  // namespace theatron::viewer
