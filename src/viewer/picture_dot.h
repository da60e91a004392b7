// SPDX-License-Identifier: Apache-2.0
// How the picture is, as the dot of the bar says it.
//
// Pure.
#pragma once

#include <cstddef>
#include <optional>

#include "client/participant.h"
#include "window/tool_bar.h"

namespace theatron::viewer {

struct DotFacts {
    client::Participant::Phase phase = client::Participant::Phase::joined;
    bool has_picture = false;
    std::optional<double> age_ms;      // as in Facts
    bool is_of_another_time = false;   // frozen, looked back at, or played
    bool is_missing_a_camera = false;  // one of several is not live
    bool is_late = false;              // this computer is too slow, or the host sends less
    std::size_t unrest = 0;            // CameraUnrest::count()
};

// Its command is not set.
window::PictureDot picture_dot(const DotFacts& facts);

}  // namespace theatron::viewer
