// SPDX-License-Identifier: Apache-2.0
// The part of a camera's depth picture that a rectangle over the view shows. Pure.
#pragma once

#include <optional>

#include "render/camera_view.h"
#include "session/camera_adjustment.h"
#include "viewer/cloud_pick.h"

namespace theatron::viewer {

// Between two corners, in shares of the picture's width and height.
struct ViewRectangle {
    Vec2 from, to;
    bool operator==(const ViewRectangle&) const = default;
};

// The smallest box with all pixels of the camera whose points lie within the rectangle and in
// front: what this camera sees behind them does not count. Nullopt where these are fewer than
// least_region_pixels.
inline constexpr int least_region_pixels = 50;
std::optional<session::PictureBox> drawn_region(const ViewRectangle& rectangle,
                                                const render::CameraView& view,
                                                const CloudCamera& camera);

}  // namespace theatron::viewer
