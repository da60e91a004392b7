// SPDX-License-Identifier: Apache-2.0
// Measures the rows of table1.h with the other benchmarks' own functions.
#pragma once

#include <string>
#include <vector>

#include "bench_headset.h"
#include "capture/camera.h"
#include "table1.h"

namespace theatron::bench {

struct Table1Options {
    // One or two, specifications; the second one is for rows with two cameras, which otherwise
    // have the first one twice.
    std::vector<std::string> cameras;
    int frames = 60;  // at most, of each camera
    int runs = 3;     // of everything; they take turns
    Size eye = vive_pro_eye;
    HeadsetTiming headset;
    double session_seconds = 6;  // of each session, and two before
};

// The whole with small inputs: says that everything works, and little about times.
void make_quick(Table1Options& options);

// Some minutes on two cores. A part that fails has its reason in the result; only cameras that
// cannot be opened throw Error.
Table1Measured measure_table1(const Table1Options& options, const capture::Progress& progress);

}  // namespace theatron::bench
