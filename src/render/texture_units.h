// SPDX-License-Identifier: Apache-2.0
// The texture unit of each sampler of the cloud shaders, in one place, so that no two passes that
// draw together take the same one.
#pragma once

namespace theatron::render::texture_unit {

// Images of the camera that is drawn; see CloudCamera::bind.
inline constexpr int depth_image = 0, rays = 1, color_picture = 2;
inline constexpr int nearest_in_color = 3;                                 // ColorVisibility
inline constexpr int edge_distances = 4;                                   // EdgeMaps
inline constexpr int refined_depth = 7, surfaces = 8, refined_before = 9;  // SurfaceMaps
inline constexpr int steady_color = 10, steady_before = 11;                // SteadyColors
inline constexpr int edges_whole = 12, edges_before = 13;  // EdgeMaps, while it draws
inline constexpr int layer_colors = 5, layer_depths = 6;   // blend

}  // namespace theatron::render::texture_unit
