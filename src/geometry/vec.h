// SPDX-License-Identifier: Apache-2.0
// Vectors, rotations and rigid poses, as far as the product needs them.
//
// Rotations are unit quaternions. Poses name both frames and read as they
// multiply: room_from_camera * point_in_camera. Lengths are metres.
#pragma once

#include <cmath>
#include <numbers>

namespace theatron {

constexpr double radians_of(double degrees) {
    return degrees * std::numbers::pi / 180;
}

struct Vec2 {
    double x = 0, y = 0;
    bool operator==(const Vec2&) const = default;
};

struct Vec3 {
    double x = 0, y = 0, z = 0;
    bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, Vec3 a) {
    return a * s;
}
constexpr double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
inline Vec3 normalized(Vec3 a) {
    return a * (1.0 / length(a));
}

struct Quat {
    double w = 1, x = 0, y = 0, z = 0;
    bool operator==(const Quat&) const = default;
};

constexpr Quat operator*(Quat a, Quat b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr Quat conjugate(Quat q) {
    return {q.w, -q.x, -q.y, -q.z};
}
inline Quat normalized(Quat q) {
    const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / n, q.x / n, q.y / n, q.z / n};
}
constexpr Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0 * cross(u, v);
    return v + q.w * t + cross(u, t);
}
inline Quat rotation_about(Vec3 axis, double radians) {
    const Vec3 u = normalized(axis) * std::sin(radians / 2);
    return {std::cos(radians / 2), u.x, u.y, u.z};
}

// Row-major 3x3, as calibration files give rotations.
struct Mat3 {
    double m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};
Quat quat_from_matrix(const Mat3& rotation);
Mat3 matrix_from_quat(Quat q);

// A rigid motion. `a_from_b` maps points of frame b to frame a.
struct Pose {
    Quat rotation;
    Vec3 translation;
    bool operator==(const Pose&) const = default;
};

constexpr Vec3 operator*(const Pose& a_from_b, Vec3 point_b) {
    return rotate(a_from_b.rotation, point_b) + a_from_b.translation;
}
constexpr Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
    return {a_from_b.rotation * b_from_c.rotation, a_from_b * b_from_c.translation};
}
constexpr Pose inverse(const Pose& a_from_b) {
    const Quat back = conjugate(a_from_b.rotation);
    return {back, -rotate(back, a_from_b.translation)};
}

// The pose of a camera (x right, y down, z forward) at `eye` facing `target`, with `up`
// pointing up in its picture. Precondition: `eye` != `target`, `up` not parallel to the view.
Pose look_at(Vec3 eye, Vec3 target, Vec3 up);

}  // namespace theatron
