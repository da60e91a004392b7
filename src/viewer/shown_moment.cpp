// SPDX-License-Identifier: Apache-2.0
#include "viewer/shown_moment.h"

#include <algorithm>

#include "pace/drawing_watch.h"

namespace theatron::viewer {

ShownMoment shown_moment(const std::map<CameraId, receive::CameraFramePtr>& frames,
                         const std::set<CameraId>& stale, TimePoint session_time) {
    ShownMoment moment;
    for (const auto& [camera, frame] : frames) {
        const double age_ms = to_ms(session_time - frame->times.captured);
        moment.age_ms = std::max(moment.age_ms, age_ms);
        if (frame->past || age_ms >= to_ms(pace::still_after) || stale.contains(camera))
            moment.is_live = false;
    }
    return moment;
}

}  // namespace theatron::viewer
