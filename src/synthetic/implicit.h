// SPDX-License-Identifier: Apache-2.0
// Bodies given as signed distances, and the meshes of their surfaces.
#pragma once

#include <functional>

#include "synthetic/mesh.h"

namespace theatron::synthetic {

// Negative inside. Need not be exact, only smooth with a slope of about one.
using Distance = std::function<float(F3)>;

inline float ball(F3 p, F3 centre, float radius) {
    return length(p - centre) - radius;
}
inline float ellipsoid(F3 p, F3 centre, F3 radii) {
    const F3 q = p - centre;
    const float k = length(q / radii), g = length(q / (radii * radii));
    return g > 1e-9f ? k * (k - 1) / g : -std::min({radii.x, radii.y, radii.z});
}
// A capsule whose radius goes from ra at a to rb at b. `along` gets 0 … 1.
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
// Union with a fillet of about k.
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

// The surface where `distance` is zero between `low` and `high`, in cells of
// `cell`, by naive surface nets; vertices are moved onto the surface and get its
// normals. The openness is read from the distances above each vertex.
Mesh make_surface(const Distance& distance, F3 low, F3 high, float cell, Look look);

// Distances sampled outwards tell how open the place is (0.3 … 1).
float openness_of(const Distance& distance, F3 position, F3 normal, float reach);

}  // namespace theatron::synthetic
