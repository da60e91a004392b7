// SPDX-License-Identifier: Apache-2.0
// The renderers' pictures beside the truth.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench_view_scene.h"

namespace theatron::bench {

// Draws the scene's noisy, filtered, coded images from its places, with each renderer (none: all
// there are), and compares with the exact pictures. Returns {gl_renderer, cameras, views, width,
// height, renderers: [{name, psnr_db, psnr_overlap_db, ssim, holes_percent, silhouette_px,
// flicker_overlap, psnr_patterned_db, psnr_patterned_fine_db, psnr_patterned_depth_sized_db,
// psnr_patterned_registered_db}]}.
//
// psnr_db and ssim: over all pixels whose surface some camera sees; psnr_overlap_db where two
// have measured it. holes_percent: of the pixels of people that some camera sees, but for those
// within two pixels of the exact outline (render::Holes). silhouette_px: how far outlines of people
// are from where they belong. flicker_overlap: root mean square of
// the change from one frame to the next where nothing moves but noise, in steps of 255.
// psnr_patterned_db: of patterned surfaces from near by, with colour pictures of
// ViewBenchOptions::color; ..._fine_db: of fine_color; ..._depth_sized_db and ..._registered_db:
// the same if colour came in the depth image's pixels, made by the functions of those names.
//
// All pictures are written to the folder `pictures`, unless it is empty. Throws Error for an
// unknown renderer, GL errors, and where there is no GL.
nlohmann::json bench_view(const ViewBenchScene& scene, std::vector<std::string> renderers,
                          const std::string& pictures, const capture::Progress& progress);

}  // namespace theatron::bench
