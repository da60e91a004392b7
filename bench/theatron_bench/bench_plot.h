// SPDX-License-Identifier: Apache-2.0
// A plot of the codecs' sizes against their times.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace theatron::bench {

// Returns an SVG picture for results of bench_depth_sequence or bench_color_sequence, with one
// panel per sequence: x is milliseconds, y is kB a frame, both logarithmic. A filled mark is
// encoding, a hollow one decoding. The picture has its own background, for light and dark pages.
std::string size_speed_svg(const nlohmann::json& sequences);

}  // namespace theatron::bench
