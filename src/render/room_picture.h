// SPDX-License-Identifier: Apache-2.0
// A whole picture: the lit scene, the clouds in it, and what is translucent before both; for
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

// Where one eye's picture goes. The target is cleared already.
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

// The left and the right eye of a person whose eyes are so far apart, looking ahead side by side,
// each through the window that `middle` looks through.
std::array<CameraView, 2> stereo_pair(const CameraView& middle, double eye_distance_m);

// The same read back: the eyes' pictures of this size beside each other. Slow, waits for the GPU.
Picture draw_and_read(const SceneFrame* scene, const std::vector<DrawnClouds>& clouds,
                      const std::vector<CameraView>& eyes, Size size, ScenePasses* passes);

}  // namespace theatron::render
