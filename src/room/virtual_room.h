// SPDX-License-Identifier: Apache-2.0
// The virtual operating room around the clouds: floor, walls, furniture (furniture/furnish.h), and
// a mark with a name where each camera stands.
//
// The real room appears as clouds in its place, so the virtual one is only visible where nothing
// was measured: its floor and walls never hide a cloud, and furniture gives way where a camera
// sees. It needs the places of the cameras: if none of them is registered there is no room. A
// meeting without cameras has a room around the origin.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "furniture/furnish.h"
#include "geometry/calibration.h"
#include "render/camera_view.h"
#include "render/scene_frame.h"
#include "room/moving.h"

namespace theatron::room {

// Labels of nearer cameras would fill the picture, and are left out.
inline constexpr double camera_label_from_m = 1.2;

struct RoomCamera {
    std::string label;
    Calibration calibration;
    bool operator==(const RoomCamera&) const = default;
};

// Large enough for these cameras and for people around them, in steps of half a metre, so that a
// camera that is moved a little changes nothing; nothing if there are cameras, but none of them is
// registered.
std::optional<RoomExtent> extent_of(const std::vector<RoomCamera>& cameras);

// Needs the GL context current in which it was made.
class VirtualRoom {
public:
    VirtualRoom();
    ~VirtualRoom();
    VirtualRoom(VirtualRoom&&) noexcept;
    VirtualRoom& operator=(VirtualRoom&&) noexcept;

    // There is no room before. Cheap if nothing has changed.
    void set_cameras(const std::vector<RoomCamera>& cameras);

    // Where people can be: inside of extent_of() and outside of the furniture; nothing if there is
    // no room.
    const std::optional<FreeSpace>& free_space() const { return space_; }

    // Makes the room for pictures of this quality, unless it is made: in some tenths of a second on
    // low, whose light is computed.
    void build(render::SceneQuality quality);
    // A step of that, at most some milliseconds. True if it was the last one.
    bool build_step(render::SceneQuality quality);

    // Appends the room's objects and texts and sets the light: labels face the eye of `view`, and a
    // mark around the eye is left out. Appends nothing if there is no room or it is not made. The
    // appended objects are valid until the next call of any other function.
    void add_to(render::SceneFrame& frame, const render::CameraView& view);

private:
    struct Meshes;
    std::optional<std::vector<RoomCamera>> cameras_;
    std::optional<FreeSpace> space_;
    std::vector<furniture::Piece> pieces_;
    std::unique_ptr<Meshes> meshes_;  // of extent and pieces; null: nothing is made
};

}  // namespace theatron::room
