// SPDX-License-Identifier: Apache-2.0
// The texts and buttons of the window in which a person's face is photographed and marked. Pure.
#pragma once

#include <optional>
#include <string>

#include "enrol/photo_guide.h"
#include "window/overlay_content.h"

namespace theatron::enrol {

// The commands of the panel's buttons.
enum class GuideCommand {
    take = 1,
    stop,
    again,
    keep,
    put,
    undo,
    back,
    leave_out,
    ask_finish,
    finish,
    keep_taking
};

// One sentence, without its full stop.
std::string reason_of(face::LandmarkFault fault);

// `has_picture`: the camera has given one.
window::OverlayContent guide_content(const PhotoGuide& guide, bool has_picture, TimePoint now);

// The button that Return and the space bar press: the first one; nullopt: there is none.
std::optional<GuideCommand> usual_command(const PhotoGuide& guide, bool has_picture);

void obey(PhotoGuide& guide, GuideCommand command, TimePoint now);

}  // namespace theatron::enrol
