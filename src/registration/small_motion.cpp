// SPDX-License-Identifier: Apache-2.0
#include "registration/small_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace theatron::registration {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int iterations = 12;
// Beforehand: keeps directions that no plane determines.
constexpr double usual_shift_m = 0.05, usual_turn = 0.03;
constexpr double coarsest_m = 0.04;  // the tolerance of the first iteration, at least

Pose pose_of(const Vector6& twist) {
    const Vec3 turn{twist[0], twist[1], twist[2]};
    const double angle = length(turn);
    return {angle > 0 ? rotation_about(turn, angle) : Quat{}, {twist[3], twist[4], twist[5]}};
}

double tukey(double apart, double tolerance) {
    const double u = apart / tolerance;
    return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
}

}  // namespace

SmallMotion fit_small_motion(const std::vector<PointOnPlane>& points, double tolerance_m) {
    SmallMotion result;
    result.points = points.size();
    if (points.size() < 12)
        return result;
    for (const PointOnPlane& p : points)
        result.share_before += (std::abs(p.apart_m) < tolerance_m) / double(points.size());

    Vec3 middle{};
    for (const PointOnPlane& p : points)
        middle = middle + p.at * (1.0 / double(points.size()));
    // About the points' middle rotation and translation hardly depend on each other.
    Pose about_middle;
    Matrix6 normal_matrix;
    for (int i = 0; i < iterations; ++i) {
        const double tolerance = std::max(tolerance_m, coarsest_m * std::pow(0.6, i));
        normal_matrix.setZero();
        Vector6 right = Vector6::Zero();
        double squares = 0, weights = 0;
        for (const PointOnPlane& p : points) {
            const Vec3 from_middle = p.at - middle, moved = about_middle * from_middle;
            const double apart = p.apart_m + dot(p.normal, moved - from_middle);
            const double w = tukey(apart, tolerance);
            if (w == 0)
                continue;
            const Vec3 turn = cross(moved, p.normal);
            Vector6 row;
            row << turn.x, turn.y, turn.z, p.normal.x, p.normal.y, p.normal.z;
            normal_matrix.selfadjointView<Eigen::Lower>().rankUpdate(row, w);
            right -= row * (w * apart);
            squares += w * apart * apart;
            weights += w;
        }
        if (weights < 12)
            return result;
        const double variance = std::max(squares / weights, 1e-8);
        result.rms_m = std::sqrt(variance);
        normal_matrix /= variance;
        right /= variance;
        for (int k = 0; k < 3; ++k) {
            normal_matrix(k, k) += 1 / (usual_turn * usual_turn);
            normal_matrix(k + 3, k + 3) += 1 / (usual_shift_m * usual_shift_m);
        }
        const Vector6 step = normal_matrix.selfadjointView<Eigen::Lower>().ldlt().solve(right);
        about_middle = pose_of(step) * about_middle;
    }
    result.motion = Pose{{}, middle} * about_middle * Pose{{}, -middle};
    double squares = 0, count = 0;
    for (const PointOnPlane& p : points) {
        const Vec3 shift = result.motion * p.at - p.at;
        if (std::abs(p.apart_m + dot(p.normal, shift)) >= tolerance_m)
            continue;
        squares += dot(shift, shift);
        ++count;
    }
    result.share = count / double(points.size());
    result.size_m = count > 0 ? std::sqrt(squares / count) : 0;
    Matrix6 full = normal_matrix.selfadjointView<Eigen::Lower>();
    result.covariance = full.inverse();
    return result;
}

}  // namespace theatron::registration
