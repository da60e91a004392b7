// SPDX-License-Identifier: Apache-2.0
// What the window tells in words: the facts at the bottom and the message in the middle.
#pragma once

#include <optional>
#include <string>

#include "client/participant.h"
#include "xr/drawing_pace.h"
#include "xr/overlay_native.h"

namespace theatron::app {

// What the window itself knows.
struct OnScreen {
    bool has_picture = false;
    std::optional<double> age_ms;  // of what is shown, now
    double drawn_per_second = 0;
    xr::DrawingWay way;
    enum class By { person, program, host } renderer_by = By::person;
    std::string address;  // of the host
};

std::vector<xr::Fact> window_facts(const client::Participant& participant, const OnScreen& screen);

// What a person must not overlook in a picture that seems all right: that it stands still.
std::string window_warning(const client::Participant::Status& status, const OnScreen& screen);

// Both empty while everything is as it should be.
struct WindowMessage {
    std::string message, detail;
};
WindowMessage window_message(const client::Participant::Status& status, const OnScreen& screen);

}  // namespace theatron::app
