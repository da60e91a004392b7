// SPDX-License-Identifier: Apache-2.0
// Cameras that stand still for a moment and go on, again and again, as under load: the first time
// is told, the others are only counted, for one sign.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "base/time.h"

namespace theatron::viewer {

// True if this remark of a participant says that a camera stands still, or is live again. `camera`:
// its name as its publisher gives it.
bool is_of_unrest(const std::string& remark, const std::string& camera);

// Not thread safe.
class CameraUnrest {
public:
    static constexpr Duration remembered = std::chrono::seconds(60);

    // True if this remark of a participant is to be told: it is about something else, or the first
    // of its kind since `remembered`. `cameras`: the names of all.
    bool tells(const std::string& remark, const std::vector<std::string>& cameras, TimePoint now);

    // Remarks that were not told, in the last `remembered`.
    std::size_t count(TimePoint now) const;

private:
    std::deque<TimePoint> seen_;  // also the one that was told
};

}  // namespace theatron::viewer
