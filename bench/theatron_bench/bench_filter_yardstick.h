// SPDX-License-Identifier: Apache-2.0
// The yardstick of the filters: a library, if it is installed.
#pragma once

#include <optional>

#include "image/image.h"

namespace theatron::bench {

// The time of OpenCV's 3x3 median of 16-bit pixels, on one thread. It treats "no measurement"
// as a distance.
std::optional<double> opencv_median_ms(const DepthImage& depth);

}  // namespace theatron::bench
