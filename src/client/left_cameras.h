// SPDX-License-Identifier: Apache-2.0
// The recorded cameras that have left a session. The message that a camera has left overtakes its
// last pictures, which may wait for a slow link or for a recorder that stood still, so a recorder
// goes on with these cameras until no picture has come for a while.
//
// Pure. Not thread safe.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "base/ids.h"
#include "base/time.h"

namespace theatron::client {

class LeftCameras {
public:
    static constexpr Duration patience = std::chrono::seconds(3);
    // They keep their numbers of the recording, which others may need.
    static constexpr std::size_t max = 16;

    // A recorded camera is in the session now, or is not. If more than `max` are not, the one that
    // has been silent for longest is forgotten.
    void update(CameraId camera, bool is_there, TimePoint now);
    // One of its pictures has come. Ignored unless the camera has left.
    void on_picture(CameraId camera, TimePoint now);
    // Forgets those whose last picture came `patience` ago, and returns them.
    std::vector<CameraId> forget_silent(TimePoint now);
    void clear() { heard_.clear(); }

    bool contains(CameraId camera) const { return heard_.contains(camera); }
    std::vector<CameraId> all() const;

private:
    std::map<CameraId, TimePoint> heard_;  // when it left, or its last picture came
};

}  // namespace theatron::client
