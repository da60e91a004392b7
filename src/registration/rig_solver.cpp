// SPDX-License-Identifier: Apache-2.0
#include "registration/rig_solver.h"

#include <Eigen/Dense>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "registration/least_squares.h"
#include "registration/view_errors.h"

namespace theatron::registration {
namespace {

// Standard deviations of depth errors that are tried, relative to RigOptions.
constexpr double error_scales[] = {1, 0.3, 0.1};

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

// All poses and depth errors. Camera 0 is the reference and does not move.
struct RigUnknowns {
    std::vector<Pose> cameras, boards;
    std::vector<Bias> biases;  // by camera
};

class Rig {
public:
    using Unknowns = RigUnknowns;

    Rig(const Start& start, const std::vector<BoardView>& views, const LatticeTarget& target,
        const RigOptions& options)
        : views_(views),
          target_(target),
          outlier_sigmas_(options.outlier_sigmas),
          bias_sigma_{options.offset_m, options.slope_m, options.slope_m, options.per_m} {
        for (const auto& camera : start.cameras) {
            start_.cameras.push_back(*camera);
            start_.biases.push_back(Bias::Zero());
            for (const double sigma : bias_sigma_)
                log_roots_ -= std::log(sigma);
        }
        seen_.assign(start.boards.size(), -1);
        for (const auto& board : start.boards)
            start_.boards.push_back(board.value_or(Pose{}));
        for (const BoardView& view : views) {
            int& number = seen_[std::size_t(view.place)];
            if (number < 0)
                number = seen_count_++;
            errors_.emplace_back(view, target, options);
            log_roots_ += errors_.back().log_root_of_depth();
        }
    }

    double cost(const RigUnknowns& at) const {
        double sum = prior_cost(at);
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const auto [edges, depth] = errors(i, at);
            sum += HuberLoss(edges.value.squaredNorm(), outlier_sigmas_).cost +
                   HuberLoss(depth.value.squaredNorm(), outlier_sigmas_).cost;
        }
        return sum;
    }

    QuadraticForm form(const RigUnknowns& at) const {
        QuadraticForm form(unknown_count());
        form.cost = prior_cost(at);
        for (std::size_t c = 0; c < at.biases.size(); ++c)
            for (int i = 0; i < bias_unknowns; ++i) {
                const double information = 1 / (bias_sigma_[i] * bias_sigma_[i]);
                form.gradient[bias_column(c) + i] += at.biases[c][i] * information;
                form.information(bias_column(c) + i, bias_column(c) + i) += information;
            }
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const auto [edges, depth] = errors(i, at);
            add(form, i, edges);
            add(form, i, depth);
        }
        return form;
    }

    RigUnknowns moved(const RigUnknowns& from, const Eigen::VectorXd& step) const {
        RigUnknowns to = from;
        for (std::size_t c = 0; c < to.cameras.size(); ++c) {
            if (c > 0)
                to.cameras[c] = registration::moved(from.cameras[c],
                                                    step.segment<pose_unknowns>(camera_column(c)));
            to.biases[c] += step.segment<bias_unknowns>(bias_column(c));
        }
        for (std::size_t b = 0; b < to.boards.size(); ++b)
            if (seen_[b] >= 0)
                to.boards[b] = registration::moved(from.boards[b],
                                                   step.segment<pose_unknowns>(board_column(b)));
        return to;
    }

    // The logarithm of the probability of all measurements under these options, up to a constant
    // that does not depend on them; after solve(). Laplace's approximation (MacKay, Neural
    // Computation 1992, "Bayesian interpolation", section 3).
    double log_evidence() const {
        QuadraticForm at_end = form(end_);
        // Directions that nothing determines do not count.
        at_end.information.diagonal().array() += 1e-6;
        const Eigen::MatrixXd root = at_end.information.llt().matrixL();
        return log_roots_ - at_end.cost - root.diagonal().array().log().sum();
    }

    RigSolution solve() {
        RigSolution solution;
        end_ = start_;
        solution.converged = minimise(*this, end_);
        const std::size_t numbers = bias_unknowns * end_.cameras.size() + 9 * views_.size();
        solution.residual = std::sqrt(2 * cost(end_) / double(numbers));
        for (std::size_t c = 0; c < end_.cameras.size(); ++c) {
            const Bias& b = end_.biases[c];
            solution.cameras.push_back(
                {end_.cameras[c], Matrix6::Zero(), {b[0], b[1], b[2], b[3]}, {}});
        }
        solution.reference_from_board = end_.boards;
        for (const BoardView& view : views_)
            solution.view_error_m.push_back(
                corner_distance_m(target_,
                                  solution.cameras[std::size_t(view.camera)].reference_from_camera *
                                      view.detection.camera_from_board,
                                  solution.reference_from_board[std::size_t(view.place)]));
        return solution;
    }

    // Adds them to the solution that solve() gave.
    void add_covariances(RigSolution& solution) const {
        const std::optional<Eigen::MatrixXd> covariance = inverse_of_scaled(form(end_).information);
        if (!covariance) {
            solution.converged = false;
            return;
        }
        for (std::size_t c = 0; c < end_.cameras.size(); ++c) {
            const Eigen::Index bias = bias_column(c);
            const Eigen::Vector4d sigma =
                covariance->diagonal().segment<bias_unknowns>(bias).cwiseSqrt();
            solution.cameras[c].bias_sigma = {sigma[0], sigma[1], sigma[2], sigma[3]};
            if (c == 0)
                continue;
            // From half angles about the reference's axes to angles about the camera's.
            const Mat3 m = matrix_from_quat(end_.cameras[c].rotation);
            Matrix3 camera_from_reference;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    camera_from_reference(i, j) = m.m[j][i];
            Matrix6 change = Matrix6::Zero();
            change.topLeftCorner<3, 3>() = 2 * camera_from_reference;
            change.bottomRightCorner<3, 3>() = camera_from_reference;
            const Eigen::Index at = camera_column(c);
            solution.cameras[c].covariance =
                change * covariance->block<pose_unknowns, pose_unknowns>(at, at) *
                change.transpose();
        }
    }

private:
    // Columns: poses of cameras from 1 on, depth errors of all cameras, poses of boards that a
    // camera sees.
    Eigen::Index camera_column(std::size_t camera) const {
        return pose_unknowns * (Eigen::Index(camera) - 1);
    }
    Eigen::Index bias_column(std::size_t camera) const {
        return camera_column(start_.cameras.size()) + bias_unknowns * Eigen::Index(camera);
    }
    Eigen::Index board_column(std::size_t board) const {
        return bias_column(start_.cameras.size()) + pose_unknowns * seen_[board];
    }
    Eigen::Index unknown_count() const {
        return bias_column(start_.cameras.size()) + pose_unknowns * seen_count_;
    }

    double prior_cost(const RigUnknowns& at) const {
        double sum = 0;
        for (const Bias& bias : at.biases)
            sum += (bias.array() / bias_sigma_.array()).square().sum() / 2;
        return sum;
    }

    ViewErrors::Both errors(std::size_t view, const RigUnknowns& at) const {
        const std::size_t camera = std::size_t(views_[view].camera);
        return errors_[view].at(at.cameras[camera], at.boards[std::size_t(views_[view].place)],
                                at.biases[camera]);
    }

    template <int n>
    void add(QuadraticForm& form, std::size_t view, const Residual<n>& residual) const {
        const HuberLoss loss(residual.value.squaredNorm(), outlier_sigmas_);
        form.cost += loss.cost;
        const Eigen::Matrix<double, view_unknowns, 1> gradient =
            loss.weight * residual.derivatives.transpose() * residual.value;
        const Eigen::Matrix<double, view_unknowns, view_unknowns> information =
            loss.weight * residual.derivatives.transpose() * residual.derivatives;
        // Where the unknowns of a view stand among all, and how many they are.
        struct Part {
            Eigen::Index in_view, in_all, count;
        };
        const std::size_t camera = std::size_t(views_[view].camera);
        const Part parts[] = {
            {0, camera_column(camera), camera > 0 ? pose_unknowns : 0},
            {pose_unknowns, board_column(std::size_t(views_[view].place)), pose_unknowns},
            {2 * pose_unknowns, bias_column(camera), bias_unknowns}};
        for (const Part& a : parts) {
            if (a.count == 0)
                continue;
            form.gradient.segment(a.in_all, a.count) += gradient.segment(a.in_view, a.count);
            for (const Part& b : parts)
                if (b.count > 0)
                    form.information.block(a.in_all, b.in_all, a.count, b.count) +=
                        information.block(a.in_view, b.in_view, a.count, b.count);
        }
    }

    const std::vector<BoardView>& views_;
    const LatticeTarget& target_;
    const double outlier_sigmas_;
    const Bias bias_sigma_;
    std::vector<ViewErrors> errors_;  // by view
    std::vector<int> seen_;           // by place: its number among those that a camera sees, or -1
    int seen_count_ = 0;
    RigUnknowns start_, end_;
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
