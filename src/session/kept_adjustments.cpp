// SPDX-License-Identifier: Apache-2.0
#include "session/kept_adjustments.h"

#include <algorithm>

namespace theatron::session {
namespace {

bool is_same_place(const Pose& a, const Pose& b) {
    constexpr double same_place_m = 1e-4, same_turn = 1e-5;  // half of an angle's sine
    const Quat turn = conjugate(a.rotation) * b.rotation;
    return length(a.translation - b.translation) < same_place_m &&
           length(Vec3{turn.x, turn.y, turn.z}) < same_turn;
}

}  // namespace

const CameraAdjustment* KeptAdjustments::find(const std::string& publisher,
                                              const std::string& camera,
                                              const Pose& registered) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const KeptAdjustment& kept) {
        return kept.publisher == publisher && kept.camera == camera &&
               is_same_place(kept.registered, registered);
    });
    return found == all_.end() ? nullptr : &found->adjustment;
}

void KeptAdjustments::keep(KeptAdjustment newest) {
    std::erase_if(all_, [&](const KeptAdjustment& kept) {
        return kept.publisher == newest.publisher && kept.camera == newest.camera;
    });
    if (newest.adjustment != CameraAdjustment{})
        all_.push_back(std::move(newest));
    if (all_.size() > max_kept)
        all_.erase(all_.begin());
}

}  // namespace theatron::session
