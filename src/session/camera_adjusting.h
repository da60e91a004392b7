// SPDX-License-Identifier: Apache-2.0
// Cameras that operators adjust while the session goes on.
//
// A pure state machine; `streams`, `look_back` and `actions` must outlive it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "session/camera_adjustment.h"
#include "session/host_actions.h"
#include "session/look_backs.h"
#include "session/streams.h"

namespace theatron::session {

class CameraAdjusting {
public:
    CameraAdjusting(Streams& streams, LookBacks& look_back, std::vector<Action>& actions)
        : streams_(streams), look_back_(look_back), actions_(actions) {}

    // Adjusts a camera, as an operator of this name does.
    wire::ManageRefusal adjust(CameraId camera, const CameraAdjustment& adjustment,
                               const std::string& by, TimePoint now);
    // Writes adjustments into the audit log.
    void on_tick(TimePoint now);

private:
    struct Adjusting {
        std::string by;
        TimePoint at;
    };

    Streams& streams_;
    LookBacks& look_back_;
    std::vector<Action>& actions_;
    std::map<CameraId, Adjusting> adjusted_;  // not yet in the audit log
};

}  // namespace theatron::session
