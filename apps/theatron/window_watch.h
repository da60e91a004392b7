// SPDX-License-Identifier: Apache-2.0
// The watch over a window of this program: a window whose drawing stands still is covered, and
// where nothing can cover it the program ends.
#pragma once

#include "xr/desktop_window_native.h"
#include "xr/window_cover_native.h"

namespace theatron::app {

class WindowWatch {
public:
    // `window` must outlive it.
    explicit WindowWatch(const xr::DesktopWindow& window);

    // The window shows what it should at this moment.
    void beat() { cover_.beat(); }
    // It shows no session.
    void rest() { cover_.rest(); }

private:
    xr::WindowCover cover_;
};

}  // namespace theatron::app
