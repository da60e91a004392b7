// SPDX-License-Identifier: Apache-2.0
// theatron join with a window.
#pragma once

#include "join_flags.h"

namespace theatron::app {

// A person without a link, or whose name is not known yet, fills in a form first, and comes back to
// it after the session. Throws Error.
void join_in_window(const JoinFlags& flags);

// The screen of an operating room, see or_screen_window.h.
void join_as_or_screen(const JoinFlags& flags);

}  // namespace theatron::app
