// SPDX-License-Identifier: Apache-2.0
// A library to compare filters with, where it is installed.
#pragma once

#include <optional>

#include "image/image.h"

namespace theatron::bench {

// The time of OpenCV's median of 3x3 pixels of 16 bits, on one thread. It takes
// "no measurement" for a distance.
std::optional<double> opencv_median_ms(const DepthImage& depth);

}  // namespace theatron::bench
