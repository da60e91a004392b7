// SPDX-License-Identifier: Apache-2.0
#include "registration/least_squares.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace theatron::registration {
namespace {

// y = a * exp(b * x), with a robust loss.
struct Exponential {
    using Unknowns = Eigen::VectorXd;  // a, b
    std::vector<double> x, y;
    double sigmas = 3;

    double cost(const Unknowns& at) const { return form(at).cost; }
    Unknowns moved(const Unknowns& from, const Eigen::VectorXd& step) const { return from + step; }
    QuadraticForm form(const Unknowns& at) const {
        QuadraticForm form(2);
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double grown = std::exp(at[1] * x[i]);
            const double residual = at[0] * grown - y[i];
            const HuberLoss loss(residual * residual, sigmas);
            const Eigen::Vector2d derivatives(grown, at[0] * x[i] * grown);
            form.cost += loss.cost;
            form.gradient += loss.weight * residual * derivatives;
            form.information += loss.weight * derivatives * derivatives.transpose();
        }
        return form;
    }
};

Exponential samples(double a, double b) {
    Exponential problem;
    for (double x = 0; x < 2; x += 0.1) {
        problem.x.push_back(x);
        problem.y.push_back(a * std::exp(b * x));
    }
    return problem;
}

TEST(LeastSquares, FindsTheExactValuesFromFarAway) {
    const Exponential problem = samples(40, -1.5);
    Eigen::VectorXd at = Eigen::Vector2d(1, 1);
    ASSERT_TRUE(minimise(problem, at));
    EXPECT_NEAR(at[0], 40, 1e-6);
    EXPECT_NEAR(at[1], -1.5, 1e-8);
}

TEST(LeastSquares, AnOutlierCountsNoMoreThanItsBound) {
    Exponential problem = samples(40, -1.5);
    problem.y[5] += 1e6;
    Eigen::VectorXd at = Eigen::Vector2d(30, -1);
    ASSERT_TRUE(minimise(problem, at));
    EXPECT_NEAR(at[0], 40, 3);
    EXPECT_NEAR(at[1], -1.5, 0.2);
}

TEST(LeastSquares, EndsWhereItsGradientVanishes) {
    Exponential problem = samples(40, -1.5);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 1);
    for (double& y : problem.y)
        y += noise(random);
    Eigen::VectorXd at = Eigen::Vector2d(20, -3);
    ASSERT_TRUE(minimise(problem, at));
    const QuadraticForm end = problem.form(at);
    const Eigen::VectorXd sigma = inverse_of_scaled(end.information)->diagonal().cwiseSqrt();
    for (int i = 0; i < 2; ++i)
        EXPECT_LT(std::abs(end.gradient[i]) * sigma[i], 1e-4) << i;
}

TEST(LeastSquares, RefusesAStartWithoutACost) {
    const Exponential problem = samples(1, 1);
    Eigen::VectorXd at = Eigen::Vector2d(1, 1e6);
    const Eigen::VectorXd before = at;
    EXPECT_FALSE(minimise(problem, at));
    EXPECT_EQ(at, before);
}

TEST(LeastSquares, ADirectionThatNothingDeterminesHasNoInverse) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Identity(3, 3);
    information(0, 0) = 1e9;  // another unit
    ASSERT_TRUE(inverse_of_scaled(information));
    EXPECT_NEAR((*inverse_of_scaled(information))(0, 0), 1e-9, 1e-15);
    information(1, 2) = information(2, 1) = 1;
    EXPECT_FALSE(inverse_of_scaled(information));
    information = Eigen::MatrixXd::Zero(2, 2);
    EXPECT_FALSE(inverse_of_scaled(information));
}

}  // namespace
}  // namespace theatron::registration
