// SPDX-License-Identifier: Apache-2.0
// The people of a room who have raised a hand, in the order in which this program saw it.
//
// Pure. Not thread safe.
#pragma once

#include <string>
#include <vector>

#include "base/ids.h"
#include "session/room_object.h"

namespace theatron::session {

class RaisedHands {
public:
    struct Hand {
        ParticipantId person{};
        std::string name;
        bool operator==(const Hand&) const = default;
    };
    // Takes over the people of the room, without those of a recording that is played. Returns those
    // who have raised a hand since the last call.
    std::vector<Hand> take(const RoomObjects& objects);
    const std::vector<Hand>& raised() const { return raised_; }
    bool has(ParticipantId person) const;

private:
    std::vector<Hand> raised_;
};

}  // namespace theatron::session
