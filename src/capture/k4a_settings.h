// SPDX-License-Identifier: Apache-2.0
// The options of a live camera, checked before the device is opened.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "base/time.h"
#include "capture/k4a_api.h"
#include "image/view.h"

namespace theatron::capture::k4a {

// A control of the colour camera. The device keeps its controls even after it is closed, so
// exposure and white balance are always set.
struct ControlSetting {
    ColorControl control = ColorControl::exposure_us;
    ControlMode mode = ControlMode::automatic;
    std::int32_t value = 0;
    const char* option = "";  // as the user writes it
    bool asked_for = false;   // by the user; false: the default
};

struct Settings {
    std::uint32_t index = 0;
    std::string serial;  // if given, it selects the device, and `index` is ignored
    Configuration configuration;
    std::vector<ControlSetting> controls;
    Size depth;
    Size color;  // 0 x 0: off
    double frames_per_second = 30;

    std::string name() const;  // as in the specification: "k4a:0"
    Duration period() const { return seconds_to_duration(1 / frames_per_second); }
};

// Throws Error for options that no camera of this kind supports.
Settings take_settings(Options& options);

}  // namespace theatron::capture::k4a
