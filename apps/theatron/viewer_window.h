// SPDX-License-Identifier: Apache-2.0
// theatron join with a window: the loop around a viewer.
#pragma once

#include "publish/camera_publisher.h"
#include "viewer/viewer.h"

namespace theatron::app {

struct ViewerWindow {
    client::Participant::Options join;
    publish::CameraPublisher* publisher = nullptr;  // of own cameras, if there are any
    viewer::Viewer::Options viewer;
    Size size{1280, 720};
    double seconds = 0;  // end this long after the first picture; 0: never
};

// Returns when the person leaves. Throws Error if the window cannot be opened, or if the host
// refused to let the person in.
void show(ViewerWindow options);

}  // namespace theatron::app
