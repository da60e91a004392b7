// SPDX-License-Identifier: Apache-2.0
// Compares the renderers' pictures with ground truth.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench_view_scene.h"

namespace theatron::bench {

// Renders the scene's images, with noise, filters and codecs applied, from its viewpoints with
// each renderer (none given: all), and compares them with the exact pictures. Returns {gl_renderer,
// cameras, views, width, height, renderers: [{name, psnr_db, psnr_overlap_db, ssim,
// holes_percent, silhouette_px, flicker_overlap, psnr_patterned_db, psnr_patterned_fine_db,
// psnr_patterned_depth_sized_db, psnr_patterned_registered_db}]}.
//
// psnr_db, ssim: over all pixels whose surface is seen by a camera. psnr_overlap_db: measured by
// two cameras. holes_percent: share of the pixels of people that are seen by a camera, without
// those within two pixels of the exact outline (render::Holes). silhouette_px: distance of
// people's outlines from the exact ones. flicker_overlap: root mean square of the change from
// frame to frame when only noise changes, in units of 1/255. psnr_patterned_db: patterned
// surfaces from nearby, with colour pictures of size ViewBenchOptions::color; ..._fine_db: of
// size fine_color; ..._depth_sized_db and ..._registered_db: with colour resampled to the depth
// image by the functions of those names.
//
// Writes all pictures to the folder `pictures`, unless it is empty. Throws Error for an unknown
// renderer, GL errors, and if there is no GL.
nlohmann::json bench_view(const ViewBenchScene& scene, std::vector<std::string> renderers,
                          const std::string& pictures, const capture::Progress& progress);

}  // namespace theatron::bench
