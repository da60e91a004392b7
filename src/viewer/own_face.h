// SPDX-License-Identifier: Apache-2.0
// The picture of the person's own face, as the viewer says it: what is sent is the program's work.
#pragma once

namespace theatron::viewer {

enum class OwnFace {
    none,     // the program has no camera for it: nothing to show
    off,      // nobody gets a picture
    opening,  // the camera is being opened, or the host asked
    seen,     // the others get it
};

}  // namespace theatron::viewer
