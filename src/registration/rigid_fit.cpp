// SPDX-License-Identifier: Apache-2.0
#include "registration/rigid_fit.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace theatron::registration {

RigidFit fit_rigid(std::span<const Vec3> from, std::span<const Vec3> to) {
    const double share = 1 / double(from.size());
    Vec3 from_mean{}, to_mean{};
    for (std::size_t i = 0; i < from.size(); ++i) {
        from_mean = from_mean + from[i] * share;
        to_mean = to_mean + to[i] * share;
    }
    Eigen::Matrix3d product = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 a = from[i] - from_mean, b = to[i] - to_mean;
        product += Eigen::Vector3d(b.x, b.y, b.z) * Eigen::RowVector3d(a.x, a.y, a.z);
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs(1, 1, 1);
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    const Eigen::Matrix3d turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    Mat3 matrix;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            matrix.m[i][j] = turn(i, j);
    RigidFit fit;
    fit.pose.rotation = quat_from_matrix(matrix);
    fit.pose.translation = to_mean - rotate(fit.pose.rotation, from_mean);
    double squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 off = fit.pose * from[i] - to[i];
        squares += dot(off, off) * share;
    }
    fit.rms_m = std::sqrt(squares);
    return fit;
}

}  // namespace theatron::registration
