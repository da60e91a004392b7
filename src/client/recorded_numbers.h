// SPDX-License-Identifier: Apache-2.0
// The numbers of a session's cameras in its recording: a recording numbers its cameras from 0,
// while a session goes on counting as cameras come and leave.
//
// Pure. Not thread safe.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/ids.h"

namespace theatron::client {

class RecordedNumbers {
public:
    // The session's cameras now. Those that left give their numbers back, which are given again
    // last. Cameras beyond wire::max_cameras get none.
    void set_cameras(const std::vector<CameraId>& cameras);
    // The number that a camera has in the recording; none if it has none.
    std::optional<CameraId> of(CameraId camera) const;

private:
    std::map<CameraId, CameraId> numbers_;  // in the recording, by that in the session
    std::size_t next_ = 0;
};

}  // namespace theatron::client
