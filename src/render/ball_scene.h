// SPDX-License-Identifier: Apache-2.0
// A small scene that is known exactly, for measuring and testing renderers: a ball
// above a table on a floor, in colours that vary with the place. Cameras see it with
// as much noise as asked for, a viewer sees it as it is.
#pragma once

#include "geometry/calibration.h"
#include "image/image.h"
#include "render/cloud_set.h"

namespace theatron::render {

// The pictures of one RGB-D camera.
struct BallSceneImages {
    DepthImage depth;
    ColorImage color;
};

// Camera `i` of `count` that stand around the table at the same angle from each other,
// `spread_degrees` from the first to the last, two metres away. Colour has `color` pixels, its
// camera stands 3 cm beside the depth camera.
Calibration ball_scene_camera(int i, int count, double spread_degrees, Size depth, Size color);

// The camera's measurement of the scene: depth in units of the calibration with Gaussian noise
// of this standard deviation, the same for equal `seed`; colour without noise. A pixel at a
// depth edge shows one of the two surfaces.
BallSceneImages ball_scene_images(const Calibration& calibration, double noise_mm, unsigned seed);

// The exact picture. Where the scene ends, depth is 0 and colour black.
Picture ball_scene_picture(const CameraView& view, Size size);

// The point that the cameras are turned to, in the room.
inline constexpr Vec3 ball_scene_middle{0, 0.9, 0};

// The picture that every renderer's golden picture is of: two cameras, seen from between.
inline constexpr Size golden_picture_size{80, 60};
CameraView golden_view();
void show_golden_scene(CloudSet& scene);
// The same view of three cameras of different sensors: sizes, lenses, units of depth, and colour
// beside the depth camera, registered to it, or none.
void show_mixed_golden_scene(CloudSet& scene);

}  // namespace theatron::render
