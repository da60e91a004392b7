// SPDX-License-Identifier: Apache-2.0
#include "registration/rig_solver.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Dense>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace theatron::registration {
namespace {

// Standard deviations of depth errors that are tried, relative to RigOptions.
constexpr double error_scales[] = {1, 0.3, 0.1};

// A pose as the solver has it: quaternion w x y z, then translation.
using Block = std::array<double, 7>;
using Bias = std::array<double, 4>;

Block block_of(const Pose& p) {
    return {p.rotation.w,    p.rotation.x,    p.rotation.y,   p.rotation.z,
            p.translation.x, p.translation.y, p.translation.z};
}

Pose pose_of(const Block& b) {
    return {normalized(Quat{b[0], b[1], b[2], b[3]}), {b[4], b[5], b[6]}};
}

template <class T>
struct PoseOf {
    T rotation[4], translation[3];

    void apply(const T* in, T* out) const {
        ceres::QuaternionRotatePoint(rotation, in, out);
        for (int i = 0; i < 3; ++i)
            out[i] += translation[i];
    }
};

template <class T>
PoseOf<T> constant(const Pose& p) {
    return {{T(p.rotation.w), T(p.rotation.x), T(p.rotation.y), T(p.rotation.z)},
            {T(p.translation.x), T(p.translation.y), T(p.translation.z)}};
}

// The inverse of `a` times `b`.
template <class T>
PoseOf<T> relative(const T* a, const T* b) {
    const T back[4] = {a[0], -a[1], -a[2], -a[3]};
    const T apart[3] = {b[4] - a[4], b[5] - a[5], b[6] - a[6]};
    PoseOf<T> result;
    ceres::QuaternionProduct(back, b, result.rotation);
    ceres::QuaternionRotatePoint(back, apart, result.translation);
    return result;
}

template <class T>
PoseOf<T> product(const PoseOf<T>& a, const PoseOf<T>& b) {
    PoseOf<T> result;
    ceres::QuaternionProduct(a.rotation, b.rotation, result.rotation);
    a.apply(b.translation, result.translation);
    return result;
}

// The pose that a view's edges say, against where camera and board are thought to be.
struct EdgeError {
    Pose face_from_camera;  // by the edges
    Pose board_from_face;
    Matrix6 root_information;  // its transpose times itself is the inverse of the covariance

    template <class T>
    bool operator()(const T* camera, const T* board, T* residual) const {
        const PoseOf<T> error =
            product(constant<T>(face_from_camera),
                    product(relative(camera, board), constant<T>(board_from_face)));
        Eigen::Matrix<T, 6, 1> step;
        ceres::QuaternionToAngleAxis(error.rotation, step.data());
        for (int i = 0; i < 3; ++i)
            step[3 + i] = error.translation[i];
        Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
        out = root_information.cast<T>() * step;
        return true;
    }
};

// The depth that a view measures on the face.
struct DepthError {
    Plane plane;
    std::array<Vec3, 3> places;  // in the board's frame
    Matrix3 root_information;

    template <class T>
    bool operator()(const T* camera, const T* board, const T* bias, T* residual) const {
        const PoseOf<T> camera_from_board = relative(camera, board);
        Eigen::Matrix<T, 3, 1> longer;
        for (int i = 0; i < 3; ++i) {
            const Vec3& place = places[std::size_t(i)];
            const T at[3] = {T(place.x), T(place.y), T(place.z)};
            T p[3];
            camera_from_board.apply(at, p);
            const T x = p[0] / p[2], y = p[1] / p[2];
            const T measured = T(1) / (plane.q.x * x + plane.q.y * y + plane.q.z);
            longer[i] = measured - p[2] - DepthBias::at(bias, x, y, p[2]);
        }
        Eigen::Map<Eigen::Matrix<T, 3, 1>> out(residual);
        out = root_information.cast<T>() * longer;
        return true;
    }
};

struct BiasPrior {
    Bias sigma;

    template <class T>
    bool operator()(const T* bias, T* residual) const {
        for (std::size_t i = 0; i < sigma.size(); ++i)
            residual[i] = bias[i] / sigma[i];
        return true;
    }
};

template <int n>
Eigen::Matrix<double, n, n> root_of_inverse(const Eigen::Matrix<double, n, n>& covariance) {
    const Eigen::Matrix<double, n, n> information = covariance.inverse();
    return information.llt().matrixU();
}

EdgeError edge_error(const BoardView& view, const LatticeTarget& target) {
    const LatticeFit& fit = view.detection.fit;
    return {inverse(fit.camera_from_face_by_edges),
            board_from_face(target, view.detection.match.face),
            root_of_inverse<6>(fit.edge_covariance)};
}

DepthError depth_error(const BoardView& view, const LatticeTarget& target,
                       const RigOptions& options) {
    const LatticeFit& fit = view.detection.fit;
    const Pose from_face = board_from_face(target, view.detection.match.face);
    DepthError error{fit.plane, {}, {}};
    Matrix3 rays;
    Eigen::Vector3d squares;
    int i = 0;
    for (const Vec3& place : depth_places(target)) {
        const Vec3 p = fit.camera_from_face * place;
        rays.row(i) << p.x / p.z, p.y / p.z, 1;
        squares[i] = p.z * p.z;
        error.places[std::size_t(i++)] = from_face * place;
    }
    Matrix3 covariance = squares.asDiagonal() * rays * fit.plane_covariance * rays.transpose() *
                         squares.asDiagonal();
    covariance.array() += options.view_common_m * options.view_common_m;
    covariance.diagonal().array() += options.view_slow_m * options.view_slow_m;
    error.root_information = root_of_inverse<3>(covariance);
    return error;
}

// Poses by following views from camera 0.
struct Start {
    std::vector<std::optional<Pose>> cameras, boards;

    Start(int camera_count, int places, const std::vector<BoardView>& views)
        : cameras(std::size_t(camera_count)), boards(std::size_t(places)) {
        cameras[0] = Pose{};
        for (bool grown = true; grown;) {
            grown = false;
            for (const BoardView& view : views) {
                auto& camera = cameras[std::size_t(view.camera)];
                auto& board = boards[std::size_t(view.place)];
                if (camera && !board)
                    board = *camera * view.detection.camera_from_board;
                else if (board && !camera)
                    camera = *board * inverse(view.detection.camera_from_board);
                else
                    continue;
                grown = true;
            }
        }
    }
};

class Rig {
public:
    Rig(const Start& start, const std::vector<BoardView>& views, const LatticeTarget& target,
        const RigOptions& options)
        : views_(views), target_(target), biases_(start.cameras.size(), Bias{}) {
        for (const auto& camera : start.cameras)
            cameras_.push_back(block_of(*camera));
        // The pose of a board that no camera sees does not change.
        for (const auto& board : start.boards)
            boards_.push_back(block_of(board.value_or(Pose{})));
        add_parameters();
        add_views(options);
    }

    // The logarithm of the probability of all measurements under these options, up to a constant
    // that does not depend on them; after solve(). Laplace's approximation (MacKay, Neural
    // Computation 1992, "Bayesian interpolation", section 3).
    double log_evidence() {
        ceres::CRSMatrix sparse;
        double cost = 0;
        problem_.Evaluate({}, &cost, nullptr, nullptr, &sparse);
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
        for (int row = 0; row < sparse.num_rows; ++row)
            for (int i = sparse.rows[std::size_t(row)]; i < sparse.rows[std::size_t(row) + 1]; ++i)
                jacobian(row, sparse.cols[std::size_t(i)]) = sparse.values[std::size_t(i)];
        Eigen::MatrixXd information = jacobian.transpose() * jacobian;
        // Directions that nothing determines, as of a board that no camera sees, do not count.
        information.diagonal().array() += 1e-6;
        const Eigen::MatrixXd root = information.llt().matrixL();
        return log_roots_ - cost - root.diagonal().array().log().sum();
    }

    RigSolution solve() {
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_SCHUR;
        options.max_num_iterations = 100;
        options.function_tolerance = 1e-10;
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem_, &summary);

        RigSolution solution;
        solution.converged = summary.IsSolutionUsable();
        solution.residual = std::sqrt(2 * summary.final_cost / std::max(1, summary.num_residuals));
        for (std::size_t c = 0; c < cameras_.size(); ++c) {
            const Bias& b = biases_[c];
            solution.cameras.push_back(
                {pose_of(cameras_[c]), Matrix6::Zero(), {b[0], b[1], b[2], b[3]}, {}});
        }
        for (const Block& board : boards_)
            solution.reference_from_board.push_back(pose_of(board));
        for (const BoardView& view : views_)
            solution.view_error_m.push_back(
                corner_distance_m(target_,
                                  solution.cameras[std::size_t(view.camera)].reference_from_camera *
                                      view.detection.camera_from_board,
                                  solution.reference_from_board[std::size_t(view.place)]));
        return solution;
    }

    // Adds them to the solution that solve() gave.
    void add_covariances(RigSolution& solution) {
        std::vector<std::pair<const double*, const double*>> wanted;
        for (std::size_t c = 0; c < cameras_.size(); ++c) {
            if (c > 0)
                wanted.push_back({cameras_[c].data(), cameras_[c].data()});
            wanted.push_back({biases_[c].data(), biases_[c].data()});
        }
        ceres::Covariance::Options options;
        options.algorithm_type = ceres::DENSE_SVD;
        ceres::Covariance covariance(options);
        if (!covariance.Compute(wanted, &problem_)) {
            solution.converged = false;
            return;
        }
        for (std::size_t c = 0; c < cameras_.size(); ++c) {
            Eigen::Matrix<double, 4, 4, Eigen::RowMajor> bias;
            covariance.GetCovarianceBlock(biases_[c].data(), biases_[c].data(), bias.data());
            const Eigen::Vector4d sigma = bias.diagonal().cwiseSqrt();
            solution.cameras[c].bias_sigma = {sigma[0], sigma[1], sigma[2], sigma[3]};
            if (c == 0)
                continue;
            Eigen::Matrix<double, 6, 6, Eigen::RowMajor> block;
            covariance.GetCovarianceBlockInTangentSpace(cameras_[c].data(), cameras_[c].data(),
                                                        block.data());
            // The solver's tangent is half the angle, about the reference's axes: to the camera's.
            const Mat3 m = matrix_from_quat(pose_of(cameras_[c]).rotation);
            Matrix3 camera_from_reference;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    camera_from_reference(i, j) = m.m[j][i];
            Matrix6 change = Matrix6::Zero();
            change.topLeftCorner<3, 3>() = 2 * camera_from_reference;
            change.bottomRightCorner<3, 3>() = camera_from_reference;
            solution.cameras[c].covariance = change * block * change.transpose();
        }
    }

private:
    void add_parameters() {
        using PoseManifold =
            ceres::ProductManifold<ceres::QuaternionManifold, ceres::EuclideanManifold<3>>;
        for (auto* blocks : {&cameras_, &boards_})
            for (Block& block : *blocks)
                problem_.AddParameterBlock(block.data(), 7, new PoseManifold);
        problem_.SetParameterBlockConstant(cameras_[0].data());
    }

    void add_views(const RigOptions& options) {
        const Bias sigma{options.offset_m, options.slope_m, options.slope_m, options.per_m};
        for (Bias& bias : biases_) {
            for (const double one : sigma)
                log_roots_ -= std::log(one);
            problem_.AddResidualBlock(
                new ceres::AutoDiffCostFunction<BiasPrior, 4, 4>(new BiasPrior{sigma}), nullptr,
                bias.data());
        }
        for (const BoardView& view : views_) {
            auto* const depth = new DepthError(depth_error(view, target_, options));
            log_roots_ += depth->root_information.diagonal().array().log().sum();
            double* const camera = cameras_[std::size_t(view.camera)].data();
            double* const board = boards_[std::size_t(view.place)].data();
            problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeError, 6, 7, 7>(
                                          new EdgeError(edge_error(view, target_))),
                                      new ceres::HuberLoss(options.outlier_sigmas), camera, board);
            problem_.AddResidualBlock(
                new ceres::AutoDiffCostFunction<DepthError, 3, 7, 7, 4>(depth),
                new ceres::HuberLoss(options.outlier_sigmas), camera, board,
                biases_[std::size_t(view.camera)].data());
        }
    }

    const std::vector<BoardView>& views_;
    const LatticeTarget& target_;
    std::vector<Block> cameras_, boards_;
    std::vector<Bias> biases_;
    ceres::Problem problem_;
    double log_roots_ = 0;  // of the determinants of all information that depends on the options
};

}  // namespace

double corner_distance_m(const LatticeTarget& target, const Pose& a, const Pose& b) {
    const Rect r = outline(target);
    double square = 0;
    for (const double x : {r.left, r.right})
        for (const double y : {r.bottom, r.top}) {
            const Vec3 apart = a * Vec3{x, y, 0} - b * Vec3{x, y, 0};
            square += dot(apart, apart) / 4;
        }
    return std::sqrt(square);
}

RigSolution solve_rig(int cameras, int places, const std::vector<BoardView>& views,
                      const LatticeTarget& target, const RigOptions& options) {
    assert(cameras > 0);
    for ([[maybe_unused]] const BoardView& view : views)
        assert(view.camera >= 0 && view.camera < cameras && view.place >= 0 && view.place < places);
    const Start start(cameras, places, views);
    RigSolution solution;
    for (int c = 0; c < cameras; ++c)
        if (!start.cameras[std::size_t(c)])
            solution.separate.push_back(c);
    if (!solution.separate.empty())
        return solution;
    // How large the errors of depth are is taken from how well depth and edges of all views agree
    // (type II maximum likelihood): a camera without fixed errors is not treated as if it had some.
    double best = -std::numeric_limits<double>::infinity();
    std::unique_ptr<Rig> chosen;
    for (const double fixed : error_scales)
        for (const double of_view : error_scales) {
            RigOptions scaled = options;
            scaled.offset_m *= fixed;
            scaled.slope_m *= fixed;
            scaled.per_m *= fixed;
            scaled.view_common_m *= of_view;
            scaled.view_slow_m *= of_view;
            auto rig = std::make_unique<Rig>(start, views, target, scaled);
            RigSolution found = rig->solve();
            const double evidence = rig->log_evidence();
            if (evidence > best) {
                best = evidence;
                solution = std::move(found);
                chosen = std::move(rig);
            }
        }
    // It takes longer than all else, so the other sizes go without.
    if (chosen)
        chosen->add_covariances(solution);
    return solution;
}

}  // namespace theatron::registration
