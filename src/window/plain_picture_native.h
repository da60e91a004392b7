// SPDX-License-Identifier: Apache-2.0
// A picture that fills the window, without a scene.
#pragma once

#include <memory>

#include "image/view.h"

namespace theatron::window {

// Needs the window's GL context current, also in the destructor.
class PlainPicture {
public:
    PlainPicture();
    ~PlainPicture();

    // Copies it into the window's framebuffer, scaled to `window`. The picture is not empty.
    void show(ColorView picture, Size window);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::window
