// SPDX-License-Identifier: Apache-2.0
// Measures the renderers on the available GL, offscreen.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench_clouds.h"

namespace theatron::bench {

// `count` cameras around a small generated scene, on half a circle, with the sizes of an Azure
// Kinect: 640x576 depth, 1280x720 colour.
std::vector<RenderBenchCamera> generated_render_cameras(int count);

struct RenderBench {
    std::vector<RenderBenchCamera> cameras;
    Size picture{1280, 720};
    std::vector<std::string> renderers;  // empty: all
    int depth_step = 1;                  // see render::CloudSet::set_depth_step; the check uses 1
    int repetitions = 15;
};

// Renders the clouds of all cameras with each renderer, with new uploads for every picture.
// Before that, each renderer is checked: seen from the first camera, at least 95 % of the
// camera's depth pixels must appear within 5 mm and two pixels, in their colour. The check
// includes the bare grid.
//
// Also draws the clouds with "mesh" alone and in the whole furnished room with two avatars, in both
// qualities.
//
// Returns {gl_renderer, width, height, cameras, depth_step, renderers: [{name, frame_ms,
// upload_ms}], rooms: [{name, frame_ms, build_ms}]}: medians of the wall clock around glFinish;
// uploads are per camera (depth and colour). The row bare_grid is the yardstick: the minimum that
// draws depth images as surfaces.
//
// Throws Error for an unknown renderer, no camera, a renderer that fails the check, GL errors,
// and if there is no GL.
nlohmann::json bench_render(const RenderBench& bench);

}  // namespace theatron::bench
