// SPDX-License-Identifier: Apache-2.0
#include "registration/view_errors.h"

#include <cmath>
#include <unsupported/Eigen/AutoDiff>

namespace theatron::registration {
namespace {

// A number with its derivatives by the unknowns of one view.
using Derivatives = Eigen::Matrix<double, view_unknowns, 1>;
using Number = Eigen::AutoDiffScalar<Derivatives>;

Number unknown(double value, int index) {
    return Number(value, view_unknowns, index);
}

struct Vec3N {
    Number x, y, z;
};

struct QuatN {
    Number w, x, y, z;
};

struct PoseN {
    QuatN rotation;
    Vec3N translation;
};

QuatN conjugate(const QuatN& q) {
    return {q.w, -q.x, -q.y, -q.z};
}

QuatN operator*(const QuatN& a, const QuatN& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Vec3N operator*(const QuatN& q, const Vec3N& v) {
    const QuatN turned = q * QuatN{Number(0), v.x, v.y, v.z} * conjugate(q);
    return {turned.x, turned.y, turned.z};
}

Vec3N operator*(const PoseN& pose, const Vec3N& v) {
    const Vec3N turned = pose.rotation * v;
    return {turned.x + pose.translation.x, turned.y + pose.translation.y,
            turned.z + pose.translation.z};
}

PoseN operator*(const PoseN& a, const PoseN& b) {
    return {a.rotation * b.rotation, a * b.translation};
}

// The inverse of `a` times `b`.
PoseN relative(const PoseN& a, const PoseN& b) {
    const QuatN back = conjugate(a.rotation);
    const Vec3N apart{b.translation.x - a.translation.x, b.translation.y - a.translation.y,
                      b.translation.z - a.translation.z};
    return {back * b.rotation, back * apart};
}

Vec3N constant(const Vec3& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}

PoseN constant(const Pose& p) {
    return {
        {Number(p.rotation.w), Number(p.rotation.x), Number(p.rotation.y), Number(p.rotation.z)},
        constant(p.translation)};
}

// `pose` and its derivatives by the six unknowns from `first` on.
PoseN moving(const Pose& pose, int first) {
    const QuatN turn{Number(1), unknown(0, first), unknown(0, first + 1), unknown(0, first + 2)};
    return {turn * constant(pose).rotation,
            {unknown(pose.translation.x, first + 3), unknown(pose.translation.y, first + 4),
             unknown(pose.translation.z, first + 5)}};
}

// The turn as an axis times an angle, radians.
Vec3N angle_axis(const QuatN& q) {
    const Number square = q.x * q.x + q.y * q.y + q.z * q.z;
    // At no turn the root has no derivative; the quotient is 2 there.
    if (square.value() < 1e-30)
        return {q.x * 2.0, q.y * 2.0, q.z * 2.0};
    const Number sine = sqrt(square);
    const double sign = q.w.value() < 0 ? -1 : 1;
    const Number half = atan2(Number(sine * sign), Number(q.w * sign));
    const Number scale = half * 2.0 / sine;
    return {q.x * scale, q.y * scale, q.z * scale};
}

template <int n>
Residual<n> weighed(const Eigen::Matrix<double, n, n>& root_information,
                    const std::array<Number, std::size_t(n)>& errors) {
    Residual<n> all;
    for (int i = 0; i < n; ++i) {
        all.value[i] = errors[std::size_t(i)].value();
        all.derivatives.row(i) = errors[std::size_t(i)].derivatives().transpose();
    }
    return {root_information * all.value, root_information * all.derivatives};
}

template <int n>
Eigen::Matrix<double, n, n> root_of_inverse(const Eigen::Matrix<double, n, n>& covariance) {
    const Eigen::Matrix<double, n, n> information = covariance.inverse();
    return information.llt().matrixU();
}

}  // namespace

Pose moved(const Pose& pose, const Eigen::Matrix<double, pose_unknowns, 1>& step) {
    const Vec3 half{step[0], step[1], step[2]};
    const double angle = length(half);
    const double scale = angle > 0 ? std::sin(angle) / angle : 1;
    const Quat turn{std::cos(angle), scale * half.x, scale * half.y, scale * half.z};
    return {normalized(turn * pose.rotation), pose.translation + Vec3{step[3], step[4], step[5]}};
}

ViewErrors::ViewErrors(const BoardView& view, const LatticeTarget& target,
                       const RigOptions& options)
    : face_from_camera_(inverse(view.detection.fit.camera_from_face_by_edges)),
      board_from_face_(board_from_face(target, view.detection.match.face)),
      edge_root_(root_of_inverse<6>(view.detection.fit.edge_covariance)),
      plane_(view.detection.fit.plane) {
    const LatticeFit& fit = view.detection.fit;
    Matrix3 rays;
    Eigen::Vector3d squares;
    int i = 0;
    for (const Vec3& place : depth_places(target)) {
        const Vec3 p = fit.camera_from_face * place;
        rays.row(i) << p.x / p.z, p.y / p.z, 1;
        squares[i] = p.z * p.z;
        places_[std::size_t(i++)] = board_from_face_ * place;
    }
    Matrix3 covariance = squares.asDiagonal() * rays * fit.plane_covariance * rays.transpose() *
                         squares.asDiagonal();
    covariance.array() += options.view_common_m * options.view_common_m;
    covariance.diagonal().array() += options.view_slow_m * options.view_slow_m;
    depth_root_ = root_of_inverse<3>(covariance);
}

double ViewErrors::log_root_of_depth() const {
    return depth_root_.diagonal().array().log().sum();
}

ViewErrors::Both ViewErrors::at(const Pose& reference_from_camera, const Pose& reference_from_board,
                                const Bias& bias) const {
    const PoseN camera_from_board =
        relative(moving(reference_from_camera, 0), moving(reference_from_board, pose_unknowns));
    const PoseN apart =
        constant(face_from_camera_) * (camera_from_board * constant(board_from_face_));
    const Vec3N turn = angle_axis(apart.rotation);
    const Vec3N& shift = apart.translation;

    std::array<Number, bias_unknowns> bias_numbers;
    for (int i = 0; i < bias_unknowns; ++i)
        bias_numbers[std::size_t(i)] = unknown(bias[i], 2 * pose_unknowns + i);
    std::array<Number, 3> longer;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Vec3N p = camera_from_board * constant(places_[i]);
        const Number x = p.x / p.z, y = p.y / p.z;
        const Number inverse_depth = x * plane_.q.x + y * plane_.q.y + plane_.q.z;
        const Number measured = Number(1) / inverse_depth;
        longer[i] = measured - p.z - DepthBias::at(bias_numbers.data(), x, y, p.z);
    }
    return {weighed<6>(edge_root_, {turn.x, turn.y, turn.z, shift.x, shift.y, shift.z}),
            weighed<3>(depth_root_, longer)};
}

}  // namespace theatron::registration
