// SPDX-License-Identifier: Apache-2.0
// Measures the whole pipeline from cameras to decoded images, in separate processes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace theatron::bench {

struct PipelineBench {
    std::vector<std::string> cameras;  // specifications
    int viewers = 1;
    double seconds = 20;
    double warmup_seconds = 2;
    std::string depth_codec = "strata";
    std::string color_codec = "jpeg:quality=85";
    std::string filter = "default";
};

// Runs one host and `viewers` participants as child processes. Returns
// {cameras,viewers,seconds,stages:[{name,p50_ms,p99_ms}],fps_min,frames_dropped,
// mbit_per_camera,cpu_cores,host_cores,viewer_cores (of one),
// frames_per_viewer,age_ms:{p50,p99,max}, ...}. age_ms: from captured to decoded, the
// worst of all streams and viewers. frames_dropped: frames given by the cameras after the
// warm-up and not decoded by a viewer. cameras_possible: the number of cameras that would
// saturate all cores or a single thread. frame_cpu_ms: processor time of host and viewers for a
// frame of a camera; frame_cpu_of_zstd1: beside that of zstd level 1 on a frame, before and after
// the run. target: the instruction set. Throws Error.
nlohmann::json bench_pipeline(const PipelineBench& bench);

}  // namespace theatron::bench
