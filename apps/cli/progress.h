// SPDX-License-Identifier: Apache-2.0
// Progress of long preparations on standard error: a line that is rewritten on
// a terminal, one line every ten percent elsewhere.
#pragma once

#include "capture/camera.h"

namespace theatron::cli {

capture::Progress show_progress();

}  // namespace theatron::cli
