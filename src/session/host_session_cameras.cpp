// SPDX-License-Identifier: Apache-2.0
// Decisions on cameras: they are adjusted, and the recording that they show is played.
#include <algorithm>
#include <utility>

#include "session/host_session.h"

namespace theatron::session {
namespace {

using wire::ManageRefusal;

// A slider that is moved changes a camera many times; the audit log gets the last one.
constexpr Duration audited_after = std::chrono::seconds(2);

}  // namespace

void HostSession::carry_out(ParticipantId id, const wire::AdjustCamera& wish, TimePoint now) {
    const auto adjustment = decode_adjustment(wish.adjustment);
    const ManageRefusal refusal =
        adjustment ? adjust(wish.camera, *adjustment, admission_.find(id)->name, now)
                   : ManageRefusal::beyond_limits;
    send(id, wire::Managed{wish.number, refusal});
}

ManageRefusal HostSession::adjust(CameraId camera, const CameraAdjustment& adjustment,
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

void HostSession::audit_adjustments(TimePoint now) {
    for (auto next = adjusted_.begin(); next != adjusted_.end();) {
        const auto& [by, at] = next->second;
        if (now - at < audited_after) {
            ++next;
            continue;
        }
        if (const CameraStreams* camera = streams_.cameras().find(next->first))
            actions_.push_back(
                action::Audit{{AuditEvent::What::adjusted,
                               {},
                               "",
                               {},
                               {},
                               "",
                               by,
                               camera->description().name + ": " + text_of(camera->adjustment())}});
        next = adjusted_.erase(next);
    }
}

void HostSession::carry_out(ParticipantId id, const wire::Play& wish, TimePoint) {
    if (playback_)
        actions_.push_back(action::Play{wish.action,
                                        std::clamp(wish.position, Duration(0), playback_->length),
                                        admission_.find(id)->name});
    send(id, wire::Managed{wish.number,
                           playback_ ? ManageRefusal::none : ManageRefusal::nothing_to_play});
}

void HostSession::carry_out(ParticipantId id, const wire::LookBack& wish, TimePoint now) {
    const bool may = admission_.find(id)->has(wire::Feature::look_back);
    send(id, wire::Managed{wish.number, may ? look_back_.begin(id, wish.ago, now)
                                            : ManageRefusal::nothing_kept});
}

void HostSession::set_playback(const wire::Playback& playback) {
    playback_ = playback;
    for (const auto& [id, participant] : admission_.participants())
        if (participant.takes_part())
            tell_playback(id);
}

void HostSession::tell_playback(ParticipantId id) {
    if (playback_ && admission_.find(id)->has(wire::Feature::playback))
        send(id, *playback_);
}

}  // namespace theatron::session
