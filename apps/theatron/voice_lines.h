// SPDX-License-Identifier: Apache-2.0
// Lines of `theatron join` on one's own microphone and loudspeaker, for scripts and tests.
#pragma once

#include <string>

#include "voice_line.h"

namespace theatron::app {

// Carries out a line: "microphone on", "microphone off", "microphone push" (only while the key is
// held), "talk on" or "talk off" (the key), "use microphone NAME" or "use speaker NAME" for another
// device. False if it is another one.
bool obey_voice_line(VoiceLine& voice, const std::string& line);

}  // namespace theatron::app
