// SPDX-License-Identifier: Apache-2.0
// The renderers measured on whatever GL there is, offscreen.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron::bench {

// One camera to draw: its calibration and a picture.
struct RenderBenchCamera {
    Calibration calibration;
    DepthImage depth;
    ColorImage color;
};

// `count` cameras around a small generated scene, half a circle from first to last, with
// the sizes of an Azure Kinect: 640x576 depth, 1280x720 colour.
std::vector<RenderBenchCamera> generated_render_cameras(int count);

struct RenderBench {
    std::vector<RenderBenchCamera> cameras;
    Size picture{1280, 720};
    std::vector<std::string> renderers;  // none: all there are
    int depth_step = 1;  // see render::CloudScene::set_depth_step; the check has all
    int repetitions = 15;
};

// Draws with each renderer what all cameras see, every time with newly uploaded images.
// Before that each renderer must show the first camera's picture as the camera saw
// it: at least 95 % of its depth pixels within 5 mm and two pixels, in their colour. The
// bare grid is held to it, too.
//
// Returns {gl_renderer, width, height, cameras, depth_step, renderers: [{name, frame_ms,
// upload_ms}]}: medians of the wall clock around glFinish, uploads per camera (depth and colour).
// The row bare_grid is the yardstick: the least that draws the depth images as surfaces.
//
// Throws Error for an unknown renderer, no camera, a renderer that draws wrongly, GL
// errors, and where there is no GL.
nlohmann::json bench_render(const RenderBench& bench);

}  // namespace theatron::bench
