// SPDX-License-Identifier: Apache-2.0
// Single-precision vectors and affine maps for meshes and shading, which process millions of
// them. Camera poses use double precision (geometry/vec.h).
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/vec.h"

namespace theatron::synthetic {

inline constexpr float pi = 3.14159265358979f;

struct F3 {
    float x = 0, y = 0, z = 0;
    bool operator==(const F3&) const = default;
};

constexpr F3 operator+(F3 a, F3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr F3 operator-(F3 a, F3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr F3 operator-(F3 a) {
    return {-a.x, -a.y, -a.z};
}
constexpr F3 operator*(F3 a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr F3 operator*(float s, F3 a) {
    return a * s;
}
constexpr F3 operator*(F3 a, F3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
constexpr F3 operator/(F3 a, F3 b) {
    return {a.x / b.x, a.y / b.y, a.z / b.z};
}
constexpr F3& operator+=(F3& a, F3 b) {
    return a = a + b;
}
constexpr float dot(F3 a, F3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr F3 cross(F3 a, F3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(F3 a) {
    return std::sqrt(dot(a, a));
}
// A zero vector stays zero.
inline F3 normalized(F3 a) {
    const float n = length(a);
    return n > 1e-20f ? a * (1 / n) : a;
}
constexpr float mix(float a, float b, float t) {
    return a + (b - a) * t;
}
constexpr F3 mix(F3 a, F3 b, float t) {
    return a + (b - a) * t;
}
constexpr float clamp01(float v) {
    return v < 0 ? 0 : v > 1 ? 1 : v;
}
// 0 below `from`, 1 above `to`, smooth between; `from` may be the larger.
constexpr float smoothstep(float from, float to, float v) {
    const float t = clamp01((v - from) / (to - from));
    return t * t * (3 - 2 * t);
}
constexpr F3 to_f3(Vec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}
constexpr Vec3 to_vec3(F3 v) {
    return {v.x, v.y, v.z};
}

// A unit vector perpendicular to the unit vector `n`.
inline F3 any_perpendicular(F3 n) {
    return normalized(std::abs(n.y) < 0.9f ? cross(n, {0, 1, 0}) : cross(n, {1, 0, 0}));
}

// p -> x * p.x + y * p.y + z * p.z + origin.
struct Affine {
    F3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    constexpr F3 turn(F3 v) const { return x * v.x + y * v.y + z * v.z; }
    constexpr F3 operator*(F3 p) const { return turn(p) + origin; }
    constexpr Affine operator*(const Affine& b) const {
        return {turn(b.x), turn(b.y), turn(b.z), *this * b.origin};
    }
};

// The inverse of an affine map whose axes are orthonormal.
constexpr Affine inverse_rigid(const Affine& a) {
    const F3 rx{a.x.x, a.y.x, a.z.x}, ry{a.x.y, a.y.y, a.z.y}, rz{a.x.z, a.y.z, a.z.z};
    Affine inverse{rx, ry, rz, {}};
    inverse.origin = -inverse.turn(a.origin);
    return inverse;
}

inline Affine translation(F3 offset) {
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, offset};
}
inline Affine rotation(F3 axis, float radians) {
    const Quat q = rotation_about(to_vec3(axis), radians);
    return {
        to_f3(rotate(q, {1, 0, 0})), to_f3(rotate(q, {0, 1, 0})), to_f3(rotate(q, {0, 0, 1})), {}};
}
inline Affine scaling(F3 s) {
    return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}
inline Affine to_affine(const Pose& pose) {
    const Quat q = pose.rotation;
    return {to_f3(rotate(q, {1, 0, 0})), to_f3(rotate(q, {0, 1, 0})), to_f3(rotate(q, {0, 0, 1})),
            to_f3(pose.translation)};
}

// The frame at `origin` with its z axis along `forward` and its y axis as close to `up` as
// possible.
inline Affine facing(F3 origin, F3 forward, F3 up) {
    const F3 z = normalized(forward);
    F3 x = cross(up, z);
    x = dot(x, x) > 1e-10f ? normalized(x) : any_perpendicular(z);
    return {x, cross(z, x), z, origin};
}

}  // namespace theatron::synthetic
