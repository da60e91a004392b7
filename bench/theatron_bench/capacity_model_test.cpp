// SPDX-License-Identifier: Apache-2.0
#include "capacity_model.h"

#include <gtest/gtest.h>

#include <vector>

#include "session/admission.h"

namespace theatron::bench {
namespace {

CapacityRun run_of(int cameras, int viewers, double base, double a_camera, double a_stream) {
    CapacityRun run;
    run.cameras = cameras;
    run.viewers = viewers;
    run.host_cores = base + a_camera * cameras + a_stream * cameras * viewers;
    run.viewer_cores = 0.1 * cameras;
    run.mbit_per_camera = 16;
    run.host_memory_mb = 50 + 10.0 * cameras;
    return run;
}

std::vector<CapacityRun> runs_of(double base, double a_camera, double a_stream) {
    return {run_of(1, 1, base, a_camera, a_stream), run_of(3, 1, base, a_camera, a_stream),
            run_of(1, 5, base, a_camera, a_stream), run_of(3, 5, base, a_camera, a_stream)};
}

TEST(CapacityModel, FindsThePartsOfALoadThatHasThem) {
    const auto model = capacity_model(runs_of(0.02, 0.25, 0.01));
    ASSERT_TRUE(model);
    EXPECT_NEAR(model->host_cores.base, 0.02, 1e-9);
    EXPECT_NEAR(model->host_cores.a_camera, 0.25, 1e-9);
    EXPECT_NEAR(model->host_cores.a_stream, 0.01, 1e-9);
    EXPECT_NEAR(model->host_memory_mb.a_camera, 10, 1e-9);
    EXPECT_NEAR(model->viewer_cores_a_camera, 0.1, 1e-9);
    EXPECT_NEAR(model->mbit_a_stream, 16, 1e-9);
    EXPECT_NEAR(model->largest_error, 0, 1e-9);
}

TEST(CapacityModel, NoPartIsBelowZero) {
    const auto model = capacity_model(runs_of(-0.05, 0.25, 0.01));
    ASSERT_TRUE(model);
    EXPECT_EQ(model->host_cores.base, 0);
    EXPECT_GT(model->host_cores.a_camera, 0.2);
    EXPECT_GT(model->largest_error, 0);
}

TEST(CapacityModel, RunsOfAFullMachineAreLeftOut) {
    std::vector<CapacityRun> runs = runs_of(0.02, 0.25, 0.01);
    CapacityRun full = run_of(9, 5, 0.02, 0.25, 0.01);
    full.host_cores = 1.4;
    full.carried = 0.6;
    runs.push_back(full);
    EXPECT_NEAR(capacity_model(runs)->host_cores.a_camera, 0.25, 1e-9);
    for (CapacityRun& run : runs)
        run.carried = 0.5;
    EXPECT_FALSE(capacity_model(runs));
}

TEST(CapacityModel, RunsThatDoNotTellCamerasFromViewersGiveNone) {
    EXPECT_FALSE(capacity_model({}));
    EXPECT_FALSE(capacity_model(std::vector(4, run_of(1, 1, 0, 0.25, 0.01))));
}

TEST(ViewersOf, EndAtCoresOrAtTheNetwork) {
    const CapacityModel model = *capacity_model(runs_of(0, 0.25, 0.01));
    // 0.9 of 2 cores less 2 cameras: 1.3 cores for 0.02 a viewer.
    EXPECT_EQ(viewers_of(model, 2, 2, 1e6), 65);
    EXPECT_EQ(viewers_of(model, 2, 2, 1000), 31);
    EXPECT_EQ(viewers_of(model, 9, 2, 1e6), 0);
    EXPECT_EQ(viewers_of(model, 1, 64, 1e6), session::Admission::max_participants);
}

}  // namespace
}  // namespace theatron::bench
