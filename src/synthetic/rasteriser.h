// SPDX-License-Identifier: Apache-2.0
// Visibility with exact rays: which triangle each sample of a camera sees and at
// what depth, under any lens distortion.
//
// Triangles are drawn like in any rasteriser, but a sample is tested with its own
// ray from the lens model: the three edge planes through the camera's centre
// decide, and the depth is where the ray meets the triangle's plane. So the
// result is that of ray casting, at the price of rasterising.
#pragma once

#include <limits>
#include <span>

#include "geometry/ray_table.h"
#include "synthetic/mesh.h"

namespace theatron::synthetic {

inline constexpr std::uint32_t no_triangle = ~std::uint32_t(0);
inline constexpr float nothing_seen = std::numeric_limits<float>::infinity();

// The rays of a camera's samples, `per_side` x `per_side` in each pixel.
struct SampleGrid {
    CameraModel camera;
    int per_side = 1;
    Image<Ray> rays;  // camera.size times per_side
    float shift = 0;  // how far the samples lie beside their even places, pixels
    // All rays lie within this pyramid.
    float side_x = 0, side_y = 0;
};

// One sample a pixel, exactly at its centre.
SampleGrid make_grid(const CameraModel& camera);
// Samples spread over each pixel, moved by `shift` (share of a sample's spacing);
// their rays are interpolated from those of the pixel centres.
SampleGrid make_fine_grid(const CameraModel& camera, const Image<Ray>& centres, int per_side,
                          Vec2 shift);

struct Visibility {
    Image<float> depth;              // nothing_seen where nothing is
    Image<std::uint32_t> triangles;  // no_triangle where nothing is

    void clear(Size size);
};

// Moves `room` points into the camera's frame.
void transform(std::span<const F3> room, const Affine& camera_from_room, std::vector<F3>& out);

// Draws triangles that face the camera into `seen`, numbered from `first`.
// `points` are in the camera's frame.
void rasterise(const SampleGrid& grid, std::span<const F3> points,
               std::span<const Triangle> triangles, std::uint32_t first, Visibility& seen);

// Where in the triangle (a, b, c) the ray meets it: weights of the corners.
inline F3 corner_weights(F3 a, F3 b, F3 c, Ray ray) {
    const F3 d{ray.x, ray.y, 1};
    const F3 w{dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))};
    const float sum = w.x + w.y + w.z;
    return sum != 0 ? w * (1 / sum) : F3{1, 0, 0};
}

}  // namespace theatron::synthetic
