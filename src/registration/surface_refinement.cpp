// SPDX-License-Identifier: Apache-2.0
#include "registration/surface_refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace theatron::registration {
namespace {

constexpr int iterations = 14;
constexpr double least_reach_m = 0.015;
constexpr double depth_deviation_m = 0.003;
constexpr double points_per_independent = 10;  // neighbours share their errors
constexpr int tile = 4;                        // cells on a side
constexpr std::size_t least_points = 100;
constexpr double least_gain = 0.01;

using Grids = std::vector<std::vector<SurfacePoint>>;

bool is_held_out(int cell, int width) {
    return ((cell % width) / tile + (cell / width) / tile) % 2 == 1;
}

// Cameras a and b, and the points of a on b's surfaces.
template <class Visit>
void for_each_overlap(const std::vector<SurfaceView>& views, const Grids& grids,
                      const std::vector<Pose>& poses, double reach_m, const Visit& visit) {
    for (std::size_t a = 0; a < views.size(); ++a)
        for (std::size_t b = 0; b < views.size(); ++b)
            if (a != b)
                visit(a, b,
                      overlap(grids[a], *views[b].camera, views[b].depth,
                              inverse(poses[b]) * poses[a], reach_m));
}

// The median distance of the surfaces that took no part.
double held_out_m(const std::vector<SurfaceView>& views, const Grids& grids,
                  const std::vector<Pose>& poses, double reach_m, std::size_t& count) {
    std::vector<OverlapPoint> all;
    for_each_overlap(views, grids, poses, reach_m,
                     [&](std::size_t a, std::size_t, const std::vector<OverlapPoint>& points) {
                         const int width = surface_grid_size(views[a].depth.size).width;
                         for (const OverlapPoint& point : points)
                             if (is_held_out(point.cell, width))
                                 all.push_back(point);
                     });
    count = all.size();
    return median_apart_m(all);
}

Pose moved(const Pose& pose, const Eigen::VectorXd& step, long at) {
    const Vec3 turn{step[at], step[at + 1], step[at + 2]};
    const double angle = length(turn);
    return Pose{angle > 0 ? rotation_about(turn, angle) : Quat{},
                {step[at + 3], step[at + 4], step[at + 5]}} *
           pose;
}

}  // namespace

SurfaceRefinement refine_on_surfaces(const std::vector<SurfaceView>& views,
                                     const RefinementOptions& options) {
    SurfaceRefinement result;
    Grids grids;
    for (const SurfaceView& view : views) {
        result.reference_from_camera.push_back(view.reference_from_camera);
        grids.push_back(surface_grid(*view.camera, view.depth));
    }
    const long unknowns = 6 * long(views.size() - 1);
    std::vector<Pose> poses = result.reference_from_camera;
    for (int i = 0; i < iterations; ++i) {
        const double reach = std::max(least_reach_m, options.reach_m * std::pow(0.8, i));
        Eigen::MatrixXd normal_matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
        const double unit = 1 / (depth_deviation_m * depth_deviation_m * points_per_independent);
        for_each_overlap(
            views, grids, poses, reach,
            [&](std::size_t a, std::size_t b, const std::vector<OverlapPoint>& points) {
                const int width = surface_grid_size(views[a].depth.size).width;
                for (const OverlapPoint& point : points) {
                    if (is_held_out(point.cell, width))
                        continue;
                    const double u = point.apart_m / reach;
                    const double weight = unit * (1 - u * u) * (1 - u * u);
                    const Vec3 at = poses[b] * point.at;
                    const Vec3 normal = rotate(poses[b].rotation, point.normal);
                    const Vec3 turn = cross(at, normal);
                    Eigen::Matrix<double, 6, 1> row;
                    row << turn.x, turn.y, turn.z, normal.x, normal.y, normal.z;
                    const long ia = 6 * (long(a) - 1), ib = 6 * (long(b) - 1);
                    const Matrix6 block = weight * row * row.transpose();
                    if (a > 0) {
                        normal_matrix.block<6, 6>(ia, ia) += block;
                        right.segment<6>(ia) -= weight * point.apart_m * row;
                    }
                    if (b > 0) {
                        normal_matrix.block<6, 6>(ib, ib) += block;
                        right.segment<6>(ib) += weight * point.apart_m * row;
                    }
                    if (a > 0 && b > 0) {
                        normal_matrix.block<6, 6>(ia, ib) -= block;
                        normal_matrix.block<6, 6>(ib, ia) -= block;
                    }
                }
            });
        // The given places are measurements as well: the way back to them, about the camera.
        for (std::size_t c = 1; c < views.size(); ++c) {
            const long at = 6 * (long(c) - 1);
            const Vec3 here = poses[c].translation;
            const Pose back = views[c].reference_from_camera * inverse(poses[c]);
            const Vec3 shift = back * here - here;
            const Quat q = back.rotation.w < 0 ? Quat{-back.rotation.w, -back.rotation.x,
                                                      -back.rotation.y, -back.rotation.z}
                                               : back.rotation;
            const Vec3 turn = Vec3{q.x, q.y, q.z} * 2.0;
            // A step turns about the origin and so shifts the camera: shift = t + w x here.
            Eigen::Matrix<double, 6, 6> jacobian = Eigen::Matrix<double, 6, 6>::Identity();
            jacobian.block<3, 3>(3, 0) << 0, here.z, -here.y, -here.z, 0, here.x, here.y, -here.x,
                0;
            Eigen::Matrix<double, 6, 1> wanted, weights;
            wanted << turn.x, turn.y, turn.z, shift.x, shift.y, shift.z;
            const double wt = 1 / (options.turn * options.turn),
                         ws = 1 / (options.shift_m * options.shift_m);
            weights << wt, wt, wt, ws, ws, ws;
            normal_matrix.block<6, 6>(at, at) +=
                jacobian.transpose() * weights.asDiagonal() * jacobian;
            right.segment<6>(at) += jacobian.transpose() * weights.cwiseProduct(wanted);
        }
        const Eigen::VectorXd step = normal_matrix.ldlt().solve(right);
        if (!step.allFinite())
            break;
        for (std::size_t c = 1; c < views.size(); ++c)
            poses[c] = moved(poses[c], step, 6 * (long(c) - 1));
    }
    std::size_t points_before = 0;
    result.before_m =
        held_out_m(views, grids, result.reference_from_camera, options.reach_m, points_before);
    result.after_m = held_out_m(views, grids, poses, options.reach_m, result.points);
    // Fewer surfaces that are nearer would be no gain.
    result.is_kept = points_before >= least_points && 10 * result.points >= 9 * points_before &&
                     result.after_m < (1 - least_gain) * result.before_m;
    if (result.is_kept)
        result.reference_from_camera = poses;
    else
        result.after_m = result.before_m;
    return result;
}

std::vector<Pose> with_most_places_kept(const std::vector<Pose>& before, std::vector<Pose> now) {
    // How far all cameras' places lie from those before, at 2 m, if camera k keeps its own.
    const auto cost = [&](std::size_t k) {
        const Pose correction = before[k] * inverse(now[k]);
        double sum = 0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Vec3 at{0, 0, 2};
            sum += length(correction * now[i] * at - before[i] * at);
        }
        return sum;
    };
    std::size_t best = 0;
    for (std::size_t k = 1; k < now.size(); ++k)
        if (cost(k) < cost(best))
            best = k;
    const Pose correction = before[best] * inverse(now[best]);
    for (Pose& pose : now)
        pose = correction * pose;
    return now;
}

}  // namespace theatron::registration
