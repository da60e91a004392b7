// SPDX-License-Identifier: Apache-2.0
// PCL's octree codec, in a program of its own (bench/pcl_codec.cpp) that only some builds have.
#pragma once

#include <string>
#include <vector>

#include "point_file.h"

namespace theatron::bench {

struct PclFigures {
    std::string version;
    double resolution_m = 0;
    struct Cloud {
        double bytes = 0, encode_ms = 0, decode_ms = 0;
    };
    std::vector<Cloud> clouds;
    PointCloud last;  // as it came back
};

// Why it cannot be measured here, with what helps; empty if it can.
std::string missing_pcl();

// Encodes and decodes the clouds of one camera in order. Throws Error.
PclFigures pcl_figures(const std::vector<PointCloud>& clouds);

}  // namespace theatron::bench
