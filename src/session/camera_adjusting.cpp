// SPDX-License-Identifier: Apache-2.0
#include "session/camera_adjusting.h"

namespace theatron::session {
namespace {

using wire::ManageRefusal;

// A slider that is moved changes a camera many times; the audit log gets the last one.
constexpr Duration audited_after = std::chrono::seconds(2);

}  // namespace

ManageRefusal CameraAdjusting::adjust(CameraId camera, const CameraAdjustment& adjustment,
                                      const std::string& by, TimePoint now) {
    const CameraStreams* known = streams_.cameras().find(camera);
    const bool changes_region = known && known->adjustment().region != adjustment.region;
    const ManageRefusal refusal = streams_.adjust(camera, adjustment);
    if (refusal != ManageRefusal::none)
        return refusal;
    // A region may be there to hide something.
    if (changes_region)
        look_back_.forget(camera, now);
    adjusted_[camera] = {by, now};
    actions_.push_back(action::Adjusted{camera, !changes_region});
    return refusal;
}

void CameraAdjusting::on_tick(TimePoint now) {
    for (auto next = adjusted_.begin(); next != adjusted_.end();) {
        const auto& [by, at] = next->second;
        if (now - at < audited_after) {
            ++next;
            continue;
        }
        if (const CameraStreams* camera = streams_.cameras().find(next->first))
            actions_.push_back(action::Audit{event_of_session(
                AuditEvent::What::adjusted, by,
                camera->description().name + ": " + text_of(camera->adjustment()))});
        next = adjusted_.erase(next);
    }
}

}  // namespace theatron::session
