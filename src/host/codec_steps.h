// SPDX-License-Identifier: Apache-2.0
// How the codecs of this build can send less, for session/ladder.h.
#pragma once

#include <memory>

#include "send/auto_color.h"
#include "session/ladder.h"

namespace theatron::host {

// `auto_is_h264`: what automatic colour is just now.
session::CodecSteps codec_steps(std::shared_ptr<const send::AutoColor> auto_is_h264);

}  // namespace theatron::host
