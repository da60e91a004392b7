// SPDX-License-Identifier: Apache-2.0
// Looking back at the last minute of the session, alone: keys and buttons, and the words with which
// the picture then says that it is not of the present.
#pragma once

#include <map>
#include <set>
#include <string>

#include "client/participant.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

// The cameras whose newest picture is of another moment than the others', so that they cannot be
// drawn together: while the host sends the past of `looking`, those of the present; else those that
// are still of the past. Empty while all are of the same.
std::set<CameraId> of_another_moment(const std::map<CameraId, receive::CameraFramePtr>& frames,
                                     const std::set<CameraId>& looking);

// The moment that is shown: "NOT LIVE: 23 s ago", "NOT LIVE: 23 s ago (not drawn: live camera
// left)"; empty: the present. `frames` are the newest, by camera; `looking` are the cameras whose
// past the host sends. The text ends when every camera shows the present again.
std::string past_text(const std::map<CameraId, receive::CameraFramePtr>& frames,
                      const std::set<CameraId>& looking,
                      const std::map<CameraId, std::string>& names, TimePoint session_time);

// Use from one thread.
class LookingBack {
public:
    static constexpr Duration step = std::chrono::seconds(10);
    static constexpr Duration farthest = std::chrono::seconds(60);

    // The moment that one step further back is, or nearer to the present (0), from the one that was
    // asked for last.
    Duration further(const client::Participant& participant, TimePoint now) const;
    Duration nearer(const client::Participant& participant, TimePoint now) const;
    // False: the host keeps nothing.
    bool go(Duration ago, client::Participant& participant, TimePoint now);

    // Adds the panel with its buttons. `knows_objects`: those of the room at that moment.
    void add_panel(const std::string& past, bool knows_objects,
                   const client::Participant& participant, TimePoint now, RoomPanel& panel) const;

private:
    Duration here(const client::Participant& participant, TimePoint now) const;

    Duration asked_{};  // the last one
    TimePoint asked_at_;
};

}  // namespace theatron::viewer
