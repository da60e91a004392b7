// SPDX-License-Identifier: Apache-2.0
// Decides for the cameras of a program whether automatic colour is H.264 or JPEG
// (send/color_choice.h), and says so.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/machine_load.h"
#include "base/time.h"
#include "send/auto_color.h"
#include "send/camera_lane.h"
#include "send/color_choice.h"

namespace theatron::send {

class ColorWatch {
public:
    ColorWatch();

    // For the encoders; from any thread.
    std::shared_ptr<const AutoColor> is_h264() const { return is_h264_; }
    // For CameraLane::Options of a camera with these limits: encoders of automatic colour follow
    // the choice, others are as usual.
    std::function<std::unique_ptr<video::ColorEncoder>(const video::ColorSetting&)> make_color(
        const JpegLimits& limits) const;

    // From one thread, at any rate: measures and decides once a second. A change is logged.
    void on_tick(const std::vector<const CameraLane*>& lanes, TimePoint now);

    // The choice and why, one sentence. From any thread.
    std::string reason() const;

private:
    ColorLoad measure(const std::vector<const CameraLane*>& lanes);

    const std::shared_ptr<AutoColor> is_h264_ = std::make_shared<AutoColor>(false);
    ColorChoice choice_;
    MachineLoad machine_;
    TimePoint measured_;
    mutable std::mutex mutex_;
    std::string reason_;  // guarded by mutex_
};

}  // namespace theatron::send
