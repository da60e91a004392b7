// SPDX-License-Identifier: Apache-2.0
// The people who wear a headset, as the poses that they send tell: a headset follows its person's
// hands; a mouse is a right hand alone, and only while it points.
#pragma once

#include <map>

#include "base/ids.h"
#include "base/time.h"
#include "wire/person_pose.h"

namespace theatron::viewer {

class WornHeadsets {
public:
    // Hands are often out of a headset's sight; a person keeps its figure meanwhile.
    static constexpr Duration forgotten_after = std::chrono::seconds(20);

    // The newest poses of all people; those who are not among them are forgotten.
    void take(const std::map<ParticipantId, wire::PersonPose>& poses, TimePoint now);
    bool has(ParticipantId id) const { return seen_.contains(id); }

private:
    std::map<ParticipantId, TimePoint> seen_;  // when the hands of each were there last
};

}  // namespace theatron::viewer
