// SPDX-License-Identifier: Apache-2.0
// The room of a recording that a host plays, beside its own room. A pure state machine.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "session/room_object.h"

namespace theatron::session {

class ReplayedRoom {
public:
    struct Step {
        // Objects that are new, changed or, without an object, gone.
        std::vector<std::pair<ObjectId, std::optional<RoomObject>>> changes;
        std::vector<ObjectPose> moved;  // held objects of which nothing else has changed
    };
    // The room as it was recorded, now, with its recorded numbers; an empty one ends the replay.
    Step show(const RoomObjects& recorded, TimePoint now);

    const RoomObjects& objects() const { return objects_; }  // with recorded_bit

private:
    RoomObjects objects_;
};

}  // namespace theatron::session
