// SPDX-License-Identifier: Apache-2.0
// Adjustments of cameras that outlive them: a camera that comes back, or that a host reads again
// when it restarts, stands as it was adjusted.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/vec.h"
#include "session/camera_adjustment.h"

namespace theatron::session {

// It belongs to a registered pose, and no longer holds once the camera is registered anew.
struct KeptAdjustment {
    std::string publisher, camera;  // names; no publisher: a camera of the host
    Pose registered;
    CameraAdjustment adjustment;
    bool operator==(const KeptAdjustment&) const = default;
};

class KeptAdjustments {
public:
    static constexpr std::size_t max_kept = 128;  // the oldest gives way

    // `kept`: of the previous run.
    explicit KeptAdjustments(std::vector<KeptAdjustment> kept) : all_(std::move(kept)) {}

    // Null if none was kept of this camera at this pose.
    const CameraAdjustment* find(const std::string& publisher, const std::string& camera,
                                 const Pose& registered) const;
    // Replaces the one of this camera. One that adjusts nothing is not kept.
    void keep(KeptAdjustment newest);
    // The oldest first.
    const std::vector<KeptAdjustment>& all() const { return all_; }

private:
    std::vector<KeptAdjustment> all_;
};

}  // namespace theatron::session
