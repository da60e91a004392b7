// SPDX-License-Identifier: Apache-2.0
// The virtual operating room around the clouds: floor, walls, and a mark with a name where each
// camera stands.
//
// The real room appears as clouds in its place, so the virtual one is only visible where nothing
// was measured: its floor and walls never hide a cloud. It needs the places of the cameras: if none
// of them is registered there is no room. A meeting without cameras has a room around the origin.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/calibration.h"
#include "render/camera_view.h"
#include "render/scene_frame.h"

namespace theatron::room {

struct RoomCamera {
    std::string label;
    Calibration calibration;
    bool operator==(const RoomCamera&) const = default;
};

// Floor and walls, on the ground: room coordinates of the corners, and how high the walls are.
struct RoomExtent {
    double left = 0, right = 0, back = 0, front = 0;
    double height = 0;
    bool operator==(const RoomExtent&) const = default;
};

// Large enough for these cameras and for people around them; nothing if there are cameras, but none
// of them is registered.
std::optional<RoomExtent> extent_of(const std::vector<RoomCamera>& cameras);

// Needs the GL context current in which it was made.
class VirtualRoom {
public:
    // There is no room before. Rebuilds it for these cameras. Cheap if nothing has changed.
    void set_cameras(const std::vector<RoomCamera>& cameras);

    // Floor and walls, as extent_of().
    const std::optional<RoomExtent>& extent() const { return extent_; }

    // Appends the room's objects and texts and sets the light: labels face the eye of `view`, and a
    // mark around the eye is left out. Appends nothing without extent(). The appended
    // objects are valid until the next call of set_cameras.
    void add_to(render::SceneFrame& frame, const render::CameraView& view) const;

private:
    std::optional<std::vector<RoomCamera>> cameras_;
    std::optional<RoomExtent> extent_;
    std::optional<render::SceneMesh> floor_, walls_, mark_;
};

}  // namespace theatron::room
