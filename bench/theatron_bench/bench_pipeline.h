// SPDX-License-Identifier: Apache-2.0
// The whole way from cameras to decoded images, between processes.
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

// Runs one host and `viewers` participants as processes of their own. Returns
// {cameras,viewers,seconds,stages:[{name,p50_ms,p99_ms}],fps_min,frames_dropped,
// mbit_per_camera,cpu_cores,age_ms:{p50,p99,max}, ...}; age is from captured to decoded,
// the worst of all streams and viewers; frames_dropped counts those that the host's
// cameras gave after the warm-up and a viewer did not decode. A camera takes part of a core
// and a viewer's threads; `cameras_possible` says how many would fill the first of them.
// Throws Error.
nlohmann::json bench_pipeline(const PipelineBench& bench);

}  // namespace theatron::bench
