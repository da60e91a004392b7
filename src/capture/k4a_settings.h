// SPDX-License-Identifier: Apache-2.0
// What a user may ask of a live camera, checked before the device is touched.
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

// A control of the colour camera. The device keeps what was set once, even
// when it is closed, so exposure and white balance are set each time.
struct ControlSetting {
    ColorControl control = ColorControl::exposure_us;
    ControlMode mode = ControlMode::automatic;
    std::int32_t value = 0;
    const char* option = "";  // as the user writes it
    bool asked_for = false;   // otherwise it is only the usual state
};

struct Settings {
    std::uint32_t index = 0;
    std::string serial;  // if given, it finds the device, and `index` means nothing
    Configuration configuration;
    std::vector<ControlSetting> controls;
    Size depth;
    Size color;  // 0 x 0: off
    double frames_per_second = 30;

    std::string name() const;  // as in the specification: "k4a:0"
    Duration period() const { return seconds_to_duration(1 / frames_per_second); }
};

// Throws Error for what no camera of this kind can do.
Settings take_settings(Options& options);

}  // namespace theatron::capture::k4a
