// SPDX-License-Identifier: Apache-2.0
#include "capacity_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "session/admission.h"

namespace theatron::bench {
namespace {

constexpr double least_carried = 0.98;
constexpr double usable_share = 0.9;

// Parts that come out below 0 are left out, and the others are solved again.
CapacityModel::Parts solve(const std::vector<CapacityRun>& runs, double CapacityRun::*what) {
    Eigen::MatrixXd sides(Eigen::Index(runs.size()), 3);
    Eigen::VectorXd values(Eigen::Index(runs.size()));
    for (Eigen::Index i = 0; i < sides.rows(); ++i) {
        const CapacityRun& run = runs[std::size_t(i)];
        sides.row(i) << 1, run.cameras, run.cameras * run.viewers;
        values[i] = run.*what;
    }
    Eigen::Vector3d parts;
    for (int left = 0; left < 3; ++left) {
        parts = sides.completeOrthogonalDecomposition().solve(values);
        Eigen::Index lowest = 0;
        if (parts.minCoeff(&lowest) >= 0)
            break;
        sides.col(lowest).setZero();
    }
    parts = parts.cwiseMax(0);
    return {parts[0], parts[1], parts[2]};
}

double mean(const std::vector<CapacityRun>& runs, auto value) {
    double sum = 0;
    for (const CapacityRun& run : runs)
        sum += value(run);
    return sum / double(runs.size());
}

}  // namespace

std::optional<CapacityModel> capacity_model(std::span<const CapacityRun> runs) {
    std::vector<CapacityRun> good;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(good),
                 [](const CapacityRun& run) { return run.carried >= least_carried; });
    const auto several = [&](auto value) {
        return std::any_of(good.begin(), good.end(),
                           [&](const CapacityRun& run) { return value(run) != value(good[0]); });
    };
    if (good.size() < 3 || !several([](const CapacityRun& run) { return run.cameras; }) ||
        !several([](const CapacityRun& run) { return run.viewers; }))
        return std::nullopt;
    CapacityModel model;
    model.host_cores = solve(good, &CapacityRun::host_cores);
    model.host_memory_mb = solve(good, &CapacityRun::host_memory_mb);
    model.viewer_cores_a_camera =
        mean(good, [](const CapacityRun& run) { return run.viewer_cores / run.cameras; });
    model.mbit_a_stream = mean(good, [](const CapacityRun& run) { return run.mbit_per_camera; });
    for (const CapacityRun& run : good)
        if (run.host_cores > 0)
            model.largest_error =
                std::max(model.largest_error,
                         std::abs(model.host_cores.at(run.cameras, run.viewers) - run.host_cores) /
                             run.host_cores);
    return model;
}

int viewers_of(const CapacityModel& model, int cameras, double cores, double mbit_per_s) {
    const double left = usable_share * cores - model.host_cores.at(cameras, 0);
    if (left < 0)
        return 0;
    constexpr double most = session::Admission::max_participants;
    const double by_cores =
        model.host_cores.a_stream > 0 ? left / (model.host_cores.a_stream * cameras) : most;
    const double by_network =
        model.mbit_a_stream > 0 ? mbit_per_s / (model.mbit_a_stream * cameras) : most;
    return int(std::min({by_cores, by_network, most}));
}

}  // namespace theatron::bench
