// SPDX-License-Identifier: Apache-2.0
// The room's objects and marks of the last minute, as this participant learned of them. Pure.
#pragma once

#include <chrono>
#include <deque>
#include <iterator>
#include <map>
#include <optional>

#include "session/room_object.h"

namespace theatron::viewer {

class RoomPast {
public:
    // Longer than the farthest look, which begins at an earlier key frame.
    static constexpr Duration reach = std::chrono::seconds(70);
    // The poses of a moving object that are kept lie so far apart.
    static constexpr Duration step = std::chrono::milliseconds(100);

    // The objects at `now`, in session time. If `now` goes backwards (another session), the past is
    // cleared.
    void note(const session::RoomObjects& objects, TimePoint now);

    // The objects of this moment, without people. Empty for a moment before the first call.
    session::RoomObjects at(TimePoint moment) const;
    bool knows(TimePoint moment) const { return first_ && moment >= *first_; }

private:
    struct State {
        TimePoint from;
        std::optional<session::RoomObject> object;  // nullopt: it was removed
    };
    void forget(TimePoint now);

    std::map<session::ObjectId, std::deque<State>> states_;  // by time
    std::optional<TimePoint> first_;
    TimePoint newest_;
};

}  // namespace theatron::viewer
