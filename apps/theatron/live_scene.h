// SPDX-License-Identifier: Apache-2.0
// The clouds of all cameras of a session, kept up to date.
#pragma once

#include <map>

#include "participant.h"
#include "render/cloud_scene.h"

namespace theatron::app {

// Use from one thread, with the same GL context current.
class LiveScene {
public:
    // Takes over what is new: cameras and frames. Returns the cameras whose picture
    // is new.
    std::vector<CameraId> take(Participant& participant);

    // Lets cameras that stand still fade, and others come back. True while it changes
    // what is seen.
    bool fade(const Participant& participant, TimePoint now);

    bool has_picture() const { return !newest_.empty(); }
    const std::map<CameraId, Calibration>& calibrations() const { return calibrations_; }
    // The last frame of each camera that sent one.
    const std::map<CameraId, receive::CameraFramePtr>& newest() const { return newest_; }
    render::CloudScene& clouds() { return clouds_; }

private:
    render::CloudScene clouds_;
    std::uint64_t generation_ = 0;
    std::map<CameraId, double> presence_;
    TimePoint faded_at_;
    std::map<CameraId, Calibration> calibrations_;
    std::map<CameraId, receive::CameraFramePtr> newest_;
};

}  // namespace theatron::app
