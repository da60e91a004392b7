// SPDX-License-Identifier: Apache-2.0
// The picture of the scene in a window, drawn with a part of the window's pixels on a
// slow machine. It is kept when only the texts over it change.
#pragma once

#include <memory>
#include <optional>

#include "render/cloud_set.h"

namespace theatron::window {

// Needs the window's GL context current, also in the destructor.
class ScaledPicture {
public:
    ScaledPicture();
    ~ScaledPicture();

    // The cleared picture to draw into, with `scale` (above 0, at most 1) of the
    // window's pixels on each side.
    render::DrawTarget begin(Size window, double scale);

    // Copies it into the whole window. Before the first begin() it shows the
    // background alone.
    void show(Size window) const;

    // Distance in metres, along the view's axis, of the surface that was drawn at this
    // share of the width and height from the top left corner. Empty if there is none.
    // Waits for the GPU: for a click, not for every picture.
    std::optional<double> distance_at(Vec2 place) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace theatron::window
