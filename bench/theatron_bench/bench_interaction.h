// SPDX-License-Identifier: Apache-2.0
// How late the poses of others and answers of the host are while pictures come, between processes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace theatron::bench {

struct InteractionBench {
    std::vector<std::string> cameras;  // specifications
    int people = 4;  // that move; two more move, too, act in the room and decode all pictures
    double seconds = 20;
    double warmup_seconds = 4;
    double poses_per_second = 90;  // of each
    std::string depth_codec = "strata";
    std::string color_codec = "jpeg:quality=85";
    int target_latency_ms = 150;
    // Network namespaces of host and viewer, with a link between them on which the host is
    // 10.77.0.1 (tools/link_shaper). Empty: both on loopback.
    std::string host_namespace, viewer_namespace;
    double link_delay_ms = 0;  // of that link, one way: taken off the poses' times
    // A folder of cases: the viewer fetches the first one meanwhile. Empty: none.
    std::string cases;
    // Busy threads with which the viewer's decoders share one core.
    int crowd = 0;
    // One more participant draws all cameras in a window, which needs a display.
    bool draws = false;
};

// Returns {p50_ms,p99_ms,max_ms,participants,cameras,poses,round_trip_ms:{p50,p99,max},
// grabs,host_cores,pictures:{fps_min,mbit_per_s,age_ms:{p50,p99}},case,drawn}: from the sending of
// a pose to its arrival at the viewer, minus the link's delay; actions in the room (bench_grabs.h),
// with the link's delay; the host's processor time; and the pictures' rate and age meanwhile;
// `case` is null or {mbit_per_s,got,all}; `drawn` is null or the number of pictures that the window
// has drawn. Throws Error.
nlohmann::json bench_interaction(const InteractionBench& bench);

}  // namespace theatron::bench
