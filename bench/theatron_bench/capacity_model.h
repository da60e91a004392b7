// SPDX-License-Identifier: Apache-2.0
// The load of a host and of its viewers as a function of the numbers of cameras and viewers, and
// what a machine can carry by it. Pure.
#pragma once

#include <optional>
#include <span>

namespace theatron::bench {

// A run of bench_pipeline(), with all its viewers seeing all its cameras.
struct CapacityRun {
    int cameras = 0, viewers = 0;
    double host_cores = 0;
    double viewer_cores = 0;  // of one viewer
    double mbit_per_camera = 0;
    double host_memory_mb = 0;
    double carried = 1;  // share of the offered pictures that came
};

// Cores and megabytes of the host: base + a_camera * cameras + a_stream * cameras * viewers, the
// least squares over the runs; no part is below 0.
struct CapacityModel {
    struct Parts {
        double base = 0, a_camera = 0, a_stream = 0;
        double at(double cameras, double viewers) const {
            return base + a_camera * cameras + a_stream * cameras * viewers;
        }
    };
    Parts host_cores, host_memory_mb;
    double viewer_cores_a_camera = 0;
    double mbit_a_stream = 0;
    // The largest difference between a run's host_cores and the model's, as a share of the former.
    double largest_error = 0;
};

// `runs`: at least one with one viewer, one with several, and two numbers of cameras. Runs in which
// pictures were missing are left out, because they say what a full machine does. Nullopt if the
// others are too few.
std::optional<CapacityModel> capacity_model(std::span<const CapacityRun> runs);

// Viewers of `cameras` cameras that a host with this many cores and this rate can have; 0 if it
// cannot have the cameras alone. A tenth of the cores stays free. At most those that a session
// admits.
int viewers_of(const CapacityModel& model, int cameras, double cores, double mbit_per_s);

}  // namespace theatron::bench
