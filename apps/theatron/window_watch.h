// SPDX-License-Identifier: Apache-2.0
// The watch over a window of this program: a window whose drawing stands still is covered, and
// where nothing can cover it the program ends.
#pragma once

#include "window/desktop_window_native.h"
#include "window/window_cover_native.h"

namespace theatron::app {

class WindowWatch {
public:
    // `window` must outlive it.
    explicit WindowWatch(const window::DesktopWindow& window);

    // The window shows what it should at this moment.
    void beat() { cover_.beat(); }
    // It shows no session.
    void rest() { cover_.rest(); }

private:
    window::WindowCover cover_;
};

}  // namespace theatron::app
