// SPDX-License-Identifier: Apache-2.0
// A camera's images as points in its frame, and points as a picture, drawn without a GPU: each is a
// square of one size in the room.
#pragma once

#include <utility>
#include <vector>

#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "point_file.h"
#include "render/camera_view.h"
#include "render/cloud_set.h"

namespace theatron::bench {

// One point for each depth pixel with colour. `rays` are those of the depth camera; all images have
// its size, `seen` is 0 where a pixel has no colour.
PointCloud cloud_of(const Calibration& calibration, const Image<Ray>& rays, DepthView depth,
                    ColorView color, View<const std::uint8_t> seen);

// Clouds with the place of their cameras in the room.
struct PlacedCloud {
    const PointCloud* cloud = nullptr;
    Pose room_from_camera;
};

// Nearer points hide further ones; the background of other pictures of
// clouds and 0 mm where there is none. `edge_m`: of the squares,
// which have at least one pixel.
render::Picture draw_points(const std::vector<PlacedCloud>& clouds, const render::CameraView& view,
                            Size size, double edge_m);

}  // namespace theatron::bench
