// SPDX-License-Identifier: Apache-2.0
// Dense nonlinear least squares with robust residuals (Levenberg-Marquardt), for problems of up to
// some hundred unknowns.
//
// A problem keeps its unknowns in a type of its own, so that rotations stay rotations: the solver
// sees only steps in the tangent space. Pure; no threads.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace theatron::registration {

// The quadratic form that a problem has near its unknowns: the cost after a small step d is about
// cost + gradient * d + d * information * d / 2.
struct QuadraticForm {
    double cost = 0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd information;

    explicit QuadraticForm(Eigen::Index unknowns)
        : gradient(Eigen::VectorXd::Zero(unknowns)),
          information(Eigen::MatrixXd::Zero(unknowns, unknowns)) {}
};

// Huber's loss of a residual with the squared length `square`: half of it up to `sigmas`, linear
// beyond. `weight` is its derivative by half of the square (Huber, Annals of Mathematical
// Statistics 1964).
struct HuberLoss {
    double cost, weight;

    HuberLoss(double square, double sigmas) {
        const bool inlier = square <= sigmas * sigmas;
        const double length = std::sqrt(square);
        cost = inlier ? square / 2 : sigmas * length - sigmas * sigmas / 2;
        weight = inlier ? 1 : sigmas / length;
    }
};

// The inverse of `information`, which is symmetric and positive; nullopt if some direction is not
// determined (to one part in 10^12 after its diagonal was scaled to ones).
inline std::optional<Eigen::MatrixXd> inverse_of_scaled(const Eigen::MatrixXd& information) {
    if (!(information.diagonal().minCoeff() > 0))
        return std::nullopt;
    const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * information *
                                               scale.asDiagonal());
    if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > 1e-12))
        return std::nullopt;
    const Eigen::Index n = information.rows();
    return scale.asDiagonal() * factors.solve(Eigen::MatrixXd::Identity(n, n)) * scale.asDiagonal();
}

// Minimises `problem.cost(unknowns)` from `unknowns` on. `Problem` has
//     using Unknowns = ...;                                       // copyable
//     double cost(const Unknowns&) const;
//     QuadraticForm form(const Unknowns&) const;
//     Unknowns moved(const Unknowns&, const Eigen::VectorXd& step) const;
// False if the cost is no number at the start; `unknowns` are then unchanged.
// Damping by the diagonal (Marquardt, SIAM 1963), its size after Madsen, Nielsen and Tingleff,
// "Methods for Non-Linear Least Squares Problems", 2004, section 3.2.
template <class Problem>
bool minimise(const Problem& problem, typename Problem::Unknowns& unknowns, int most_steps = 100,
              double least_gain = 1e-10) {
    // Damping never vanishes in a direction that nothing determines.
    constexpr double least_diagonal = 1e-6;
    QuadraticForm form = problem.form(unknowns);
    if (!std::isfinite(form.cost))
        return false;
    double damping = 1e-4, growth = 2;
    for (int step_count = 0; step_count < most_steps; ++step_count) {
        Eigen::MatrixXd damped = form.information;
        damped.diagonal() += damping * form.information.diagonal().cwiseMax(least_diagonal);
        const Eigen::VectorXd step = damped.ldlt().solve(-form.gradient);
        const double expected = -form.gradient.dot(step) - step.dot(form.information * step) / 2;
        if (!step.allFinite() || !(expected > least_gain * form.cost / 10))
            return true;
        auto candidate = problem.moved(unknowns, step);
        const double cost = problem.cost(candidate);
        const double gain = form.cost - cost;
        if (!(gain > 0)) {
            damping *= growth;
            growth *= 2;
            continue;
        }
        const bool settled = gain < least_gain * form.cost;
        unknowns = std::move(candidate);
        if (settled)
            return true;
        form = problem.form(unknowns);
        damping *= std::max(1.0 / 3, 1 - std::pow(2 * gain / expected - 1, 3));
        growth = 2;
    }
    return true;
}

}  // namespace theatron::registration
