// SPDX-License-Identifier: Apache-2.0
#include "registration/plane_evidence.h"

#include <Eigen/Dense>

namespace theatron::registration {

PlaneSays plane_says(const Plane& plane, const Matrix3& q_covariance, const Pose& pose,
                     const LatticeTarget& target, const DepthTrust& trust) {
    const Vec3 normal = axis_of(pose, 2);
    Eigen::Matrix<double, 3, 6> by_pose = Eigen::Matrix<double, 3, 6>::Zero();
    Eigen::Matrix3d rays;
    Eigen::Vector3d longer, depths;  // measured minus expected
    int i = 0;
    for (const Vec3& place : depth_places(target)) {
        const Vec3 p = pose * place;
        const Vec3 ray = p * (1 / p.z);
        depths[i] = 1 / plane.inverse_depth({float(ray.x), float(ray.y)});
        longer[i] = depths[i] - p.z;
        // A small motion of the face moves the point of this ray along the ray.
        const double per_normal = 1 / dot(normal, ray);
        by_pose(i, 0) = place.y * per_normal;
        by_pose(i, 1) = -place.x * per_normal;
        by_pose(i, 5) = per_normal;
        rays.row(i) << ray.x, ray.y, 1;
        ++i;
    }
    const Eigen::Vector3d squares = depths.array().square();
    Eigen::Matrix3d covariance =
        squares.asDiagonal() * rays * q_covariance * rays.transpose() * squares.asDiagonal();
    covariance.array() += trust.common_m * trust.common_m;
    covariance.diagonal().array() += trust.slow_m * trust.slow_m;
    const Eigen::Matrix3d information = covariance.inverse();
    return {by_pose.transpose() * information * by_pose,
            by_pose.transpose() * information * longer};
}

std::array<Vec3, 3> depth_places(const LatticeTarget& target) {
    const double x = target.width_m * 0.35, y = target.height_m * 0.35;
    return {Vec3{-x, -y, 0}, Vec3{x, -y, 0}, Vec3{0, y, 0}};
}

}  // namespace theatron::registration
