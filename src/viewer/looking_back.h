// SPDX-License-Identifier: Apache-2.0
// A person at the window or in the browser looks back at the last minute of the session, alone; and
// the words with which the picture then says that it is not of the present.
#pragma once

#include <map>
#include <set>
#include <string>

#include "client/participant.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

// What the picture is of. Empty: of the present. `frames`: those that are shown, by camera;
// `looking`: the cameras whose past the host sends. It is not of the present before every camera
// shows the present again.
// "NOT LIVE: 23 s ago", "NOT LIVE: 23 s ago (camera left is live)".
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

    // Adds the panel with its buttons.
    void add_panel(const std::string& past, const client::Participant& participant, TimePoint now,
                   RoomPanel& panel) const;

private:
    Duration here(const client::Participant& participant, TimePoint now) const;

    Duration asked_{};  // the last one
    TimePoint asked_at_;
};

}  // namespace theatron::viewer
