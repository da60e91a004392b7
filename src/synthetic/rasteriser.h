// SPDX-License-Identifier: Apache-2.0
// Visibility with exact rays: the triangle and depth seen by each sample of a camera, under
// any lens distortion.
//
// Triangles are rasterised, but each sample is tested with its own ray of the lens model:
// against the planes through the camera's centre and the three edges; its depth is the
// intersection with the triangle's plane. The result equals ray casting, at the cost of
// rasterising.
#pragma once

#include <limits>
#include <span>

#include "geometry/ray_table.h"
#include "synthetic/mesh.h"
#include "synthetic/pulse.h"

namespace theatron::synthetic {

inline constexpr std::uint32_t no_triangle = ~std::uint32_t(0);
inline constexpr float nothing_seen = std::numeric_limits<float>::infinity();

// The rays of a camera's samples, `per_side` x `per_side` per pixel.
struct SampleGrid {
    CameraModel camera;
    int per_side = 1;
    Image<Ray> rays;  // camera.size times per_side
    float shift = 0;  // offset of the samples from their regular positions, pixels
    // All rays are inside this pyramid.
    float side_x = 0, side_y = 0;
};

// One sample per pixel, at its centre.
SampleGrid make_grid(const CameraModel& camera);
// Samples spread over each pixel, offset by `shift` (share of a sample's spacing). Their rays
// are interpolated between those of the pixel centres.
SampleGrid make_fine_grid(const CameraModel& camera, const Image<Ray>& centres, int per_side,
                          Vec2 shift);

struct Visibility {
    Image<float> depth;              // nothing_seen if there is no triangle
    Image<std::uint32_t> triangles;  // no_triangle if there is none

    void clear(Size size);
};

// Transforms `room` points to the camera's frame.
void transform(std::span<const F3> room, const Affine& camera_from_room, std::vector<F3>& out);

// Draws triangles that face the camera into `seen`, numbered from `first`.
// `points` are in the camera's frame.
void rasterise(const SampleGrid& grid, std::span<const F3> points,
               std::span<const Triangle> triangles, std::uint32_t first, Visibility& seen,
               const Pulse& pulse = {});

// Barycentric weights of the corners at the intersection of the ray with triangle (a, b, c).
inline F3 corner_weights(F3 a, F3 b, F3 c, Ray ray) {
    const F3 d{ray.x, ray.y, 1};
    const F3 w{dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))};
    const float sum = w.x + w.y + w.z;
    return sum != 0 ? w * (1 / sum) : F3{1, 0, 0};
}

}  // namespace theatron::synthetic
