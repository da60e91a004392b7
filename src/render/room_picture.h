// SPDX-License-Identifier: Apache-2.0
// A whole picture: the lit scene, the clouds in it, and translucent objects over both; for
// one eye or for two.
//
// All functions need the GL context current in which the objects were made.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/cloud_set.h"
#include "render/scene_passes.h"

namespace theatron::render {

// One eye's view and its target, which the caller has cleared.
struct EyePicture {
    CameraView view;
    DrawTarget target;
};

// A set of clouds and how it is drawn: "blend" for the cameras of a room, say, and "mesh" for those
// of a person.
struct DrawnClouds {
    CloudSet* set = nullptr;
    std::string renderer;
};

// All that is drawn at one moment. The CloudSet keeps the list of cameras, their presence and their
// cuts, which change seldom.
struct RoomPicture {
    const SceneFrame* scene = nullptr;  // none: the clouds alone
    std::vector<DrawnClouds> clouds;
    std::vector<EyePicture> eyes;  // one, or left and right
};

// `passes` may be null where there is no scene. Throws Error if there is no such renderer.
void draw(const RoomPicture& picture, ScenePasses* passes);

// The views of the left and the right eye. Both have the orientation and the frustum of `middle`,
// and their eyes are half of `eye_distance_m` to its left and right.
std::array<CameraView, 2> stereo_pair(const CameraView& middle, double eye_distance_m);

// Draws and reads back: the eyes' pictures of this size side by side. Slow, waits for the GPU.
Picture draw_and_read(const SceneFrame* scene, const std::vector<DrawnClouds>& clouds,
                      const std::vector<CameraView>& eyes, Size size, ScenePasses* passes);

}  // namespace theatron::render
