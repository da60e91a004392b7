// SPDX-License-Identifier: Apache-2.0
// Marks in the scene, in their authors' colours and with their labels.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "render/camera_view.h"
#include "render/scene_frame.h"
#include "session/mark.h"

namespace theatron::room {

struct PlacedMark {
    session::Mark mark;
    Pose room_from_points;
    double scale = 1;                // of the points
    std::optional<render::Cut> cut;  // of the surface that it sticks to
};

// Needs the GL context current in which its first marks were added.
class MarkScene {
public:
    // Appends the marks as lines with labels. Keeps the meshes of these marks for the next call and
    // no others.
    void add_to(render::SceneFrame& frame, const std::vector<PlacedMark>& marks,
                const render::CameraView& view);

private:
    std::map<Bytes, render::SceneLineMesh> meshes_;  // by the marks' properties and scale
};

}  // namespace theatron::room
