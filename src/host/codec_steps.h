// SPDX-License-Identifier: Apache-2.0
// The codecs of this build with fewer bytes, for the steps of session/ladder.h.
#pragma once

#include <memory>

#include "send/auto_color.h"
#include "session/ladder.h"

namespace theatron::host {

// `auto_is_h264`: the current choice of automatic colour.
session::CodecSteps codec_steps(std::shared_ptr<const send::AutoColor> auto_is_h264);

}  // namespace theatron::host
