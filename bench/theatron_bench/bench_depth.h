// SPDX-License-Identifier: Apache-2.0
// Measures the depth codecs on a sequence of images: sizes and times, with verified results.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/image.h"

namespace theatron {

enum class DepthYardsticks { all, zstd };

// Encodes and decodes `frames`, all of one size, with each of `codecs` (settings such as
// "zstd:delta=1"), on one thread. Every decoded frame is compared with its original before
// anything is timed. Libraries are added as yardsticks: zstd1_raw (zstd level 1 on the raw
// pixels) always, with `all` JPEG-LS and FFV1 if this build has them.
//
// Returns {sequence, width, height, frames, codecs: [{name, lossless,
// max_error_mm, rmse_mm, bytes_first, bytes_mean, ratio, encode_ms, decode_ms}]}. Means and
// medians exclude the first frame, unless it is the only one; a frame's time is that of its
// fastest pass.
//
// Throws Error for an unknown codec, for no frames or frames of several sizes, and for a
// lossless codec that changed a pixel.
nlohmann::json bench_depth_sequence(const std::string& sequence_name,
                                    const std::vector<DepthImage>& frames,
                                    const std::vector<std::string>& codecs,
                                    DepthYardsticks yardsticks = DepthYardsticks::all);

}  // namespace theatron
