// SPDX-License-Identifier: Apache-2.0
// How the codecs of this build can send less, for session/ladder.h.
#pragma once

#include "session/ladder.h"

namespace theatron::host {

session::CodecSteps codec_steps();

}  // namespace theatron::host
