// SPDX-License-Identifier: Apache-2.0
// Darkens the sides of a picture: while a person with a headset is moved through the room, the
// still darkness at the sides makes motion sickness rarer (Fernandes and Feiner, "Combating VR
// sickness through subtle dynamic field-of-view modification", 3DUI 2016).
#pragma once

#include <memory>

#include "render/camera_view.h"
#include "render/draw_target.h"

namespace theatron::render {

// Needs the GL context current in which it was made.
class Vignette {
public:
    // Degrees from the view's axis up to which the picture stays as it is, and from which on it is
    // dark.
    static constexpr double clear_degrees = 22, dark_degrees = 36;

    Vignette();
    ~Vignette();

    // Over a finished picture. `strength`: 0 (nothing is drawn) to 1.
    void draw(const CameraView& view, const DrawTarget& target, double strength);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::render
