// SPDX-License-Identifier: Apache-2.0
// Solids as signed distance functions, and meshes of their surfaces.
#pragma once

#include <functional>

#include "synthetic/mesh.h"

namespace theatron::synthetic {

// Negative inside. Need not be exact, but smooth with a slope of about one.
using Distance = std::function<float(F3)>;

inline float ball(F3 p, F3 centre, float radius) {
    return length(p - centre) - radius;
}
inline float ellipsoid(F3 p, F3 centre, F3 radii) {
    const F3 q = p - centre;
    const float k = length(q / radii), g = length(q / (radii * radii));
    return g > 1e-9f ? k * (k - 1) / g : -std::min({radii.x, radii.y, radii.z});
}
// A capsule with radius ra at a and rb at b. `along` receives the position along it, 0 to 1.
inline float capsule(F3 p, F3 a, F3 b, float ra, float rb, float* along = nullptr) {
    const F3 d = b - a;
    const float t = clamp01(dot(p - a, d) / dot(d, d));
    if (along)
        *along = t;
    return length(p - a - d * t) - mix(ra, rb, t);
}
inline float rounded_box(F3 p, F3 centre, F3 half, float radius) {
    const F3 c = p - centre;
    const F3 q =
        F3{std::abs(c.x), std::abs(c.y), std::abs(c.z)} - half + F3{radius, radius, radius};
    const F3 outside{std::max(q.x, 0.0f), std::max(q.y, 0.0f), std::max(q.z, 0.0f)};
    return length(outside) + std::min(std::max({q.x, q.y, q.z}), 0.0f) - radius;
}
// Union with a fillet of radius about k.
inline float blend(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}
// Intersection with a fillet.
inline float both(float a, float b, float k) {
    return -blend(-a, -b, k);
}
inline float without(float a, float b, float k) {
    return both(a, -b, k);
}

// Triangulates the surface where `distance` is zero between `low` and `high`, with cells of
// size `cell`, by naive surface nets. Vertices are moved onto the surface and get its normals;
// their openness is sampled from the distances above them.
Mesh make_surface(const Distance& distance, F3 low, F3 high, float cell, Look look);

// Estimates from distances along the normal how open the place is (0.3 to 1).
float openness_of(const Distance& distance, F3 position, F3 normal, float reach);

}  // namespace theatron::synthetic
