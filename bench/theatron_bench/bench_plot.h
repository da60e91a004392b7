// SPDX-License-Identifier: Apache-2.0
// Size against speed of the codecs as a picture.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace theatron::bench {

// An SVG picture of what bench_depth_sequence or bench_color_sequence returned,
// one panel for each sequence: milliseconds across, kB a frame up, both
// logarithmic. A filled mark is encoding, a hollow one decoding. Shows light and
// dark alike: it brings its own background.
std::string size_speed_svg(const nlohmann::json& sequences);

}  // namespace theatron::bench
