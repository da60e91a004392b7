// SPDX-License-Identifier: Apache-2.0
// theatron join with a window: the loop around a viewer.
#pragma once

#include "publish/camera_publisher.h"
#include "viewer/viewer.h"
#include "xr/desktop_window_native.h"

namespace theatron::app {

struct ViewerWindow {
    client::Participant::Options join;
    publish::CameraPublisher* publisher = nullptr;  // of own cameras, if there are any
    viewer::Viewer::Options viewer;
    std::string greeting;  // shown for some seconds after the first picture
    double seconds = 0;    // end this long after the first picture; 0: never
};

// True where a desktop is named by the environment; a window may still fail to open there.
bool has_display();

// Returns when the person leaves. Throws Error if the host refused to let the person in.
void show(xr::DesktopWindow& window, ViewerWindow options);

}  // namespace theatron::app
