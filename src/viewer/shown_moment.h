// SPDX-License-Identifier: Apache-2.0
// The moment of the pictures that are shown, for files of them.
#pragma once

#include <map>
#include <set>

#include "receive/receiver.h"

namespace theatron::viewer {

struct ShownMoment {
    double age_ms = 0;  // of the oldest picture of a camera of the room
    bool is_live = true;
    bool is_recording = false;  // that the host plays
};

// `frames` are those that are shown, by camera; `stale` are the cameras that are not live.
ShownMoment shown_moment(const std::map<CameraId, receive::CameraFramePtr>& frames,
                         const std::set<CameraId>& stale, TimePoint session_time);

}  // namespace theatron::viewer
