// SPDX-License-Identifier: Apache-2.0
#include "viewer/worn_headsets.h"

namespace theatron::viewer {

void WornHeadsets::take(const std::map<ParticipantId, wire::PersonPose>& poses, TimePoint now) {
    for (const auto& [id, pose] : poses)
        if (pose.left_hand || (pose.right_hand && !pose.points))
            seen_[id] = now;
    std::erase_if(seen_, [&](const auto& one) {
        return !poses.contains(one.first) || now - one.second > forgotten_after;
    });
}

}  // namespace theatron::viewer
