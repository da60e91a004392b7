// SPDX-License-Identifier: Apache-2.0
// Decides for a host whether automatic colour is H.264 or JPEG (send/color_choice.h), and says so.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/machine_load.h"
#include "base/time.h"
#include "send/auto_color.h"
#include "send/camera_lane.h"
#include "send/color_choice.h"

namespace theatron::host {

class ColorWatch {
public:
    ColorWatch();

    // For the encoders; from any thread.
    std::shared_ptr<const send::AutoColor> is_h264() const { return is_h264_; }

    // From one thread, at any rate: measures and decides once a second. A change is logged.
    void on_tick(const std::vector<std::unique_ptr<send::CameraLane>>& lanes, TimePoint now);

    // The choice and why, one sentence. From any thread.
    std::string reason() const;

private:
    send::ColorLoad measure(const std::vector<std::unique_ptr<send::CameraLane>>& lanes);

    const std::shared_ptr<send::AutoColor> is_h264_ = std::make_shared<send::AutoColor>(false);
    send::ColorChoice choice_;
    MachineLoad machine_;
    TimePoint measured_;
    mutable std::mutex mutex_;
    std::string reason_;  // guarded by mutex_
};

}  // namespace theatron::host
