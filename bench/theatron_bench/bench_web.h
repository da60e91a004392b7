// SPDX-License-Identifier: Apache-2.0
// `theatron bench web`: the browser client in Chromium, beside a native participant.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "image/view.h"

namespace theatron::bench {

struct WebBench {
    std::vector<std::string> cameras;  // specifications; empty: two generated ones
    double seconds = 10;               // measured, after the first complete picture
    int runs = 3;
    Size size{1280, 720};  // of the page
    std::string decoding;  // "page": without workers
    std::string color;     // codec that the page asks for; empty: as it chooses
    // The generated cameras are as large as a depth camera in a room: depth and colour of 640x576,
    // in a page of 640x360.
    bool full = false;
};

// Medians of the runs. Times in ms unless named _s:
// {first_picture_s, transferred_bytes, cameras, decoders, fps_min, color_fps_min, color,
//  color_reason, color_decode_ms, mbit_per_s, dropped, pictures_per_s,
//  age_ms:{p50,p95,p99}, native_age_ms:{...}, age_over_native_ms:{...}, longest_task_ms,
//  longest_loading_task_ms, renderer, problems, and those of bench_web_decoding.h}.
// A picture is complete with depth and colour of all cameras, and counts when the GPU finished it.
// Tasks of the page's thread below 50 ms count as 0, because browsers do not tell them.
// Throws Error.
nlohmann::json bench_web(const WebBench& bench, const std::string& chromium);

void add_web_bench(CLI::App& bench);

}  // namespace theatron::bench
