// SPDX-License-Identifier: Apache-2.0
// The depth codecs measured on a sequence of images: sizes and times, checked.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/image.h"

namespace theatron {

// Encodes and decodes `frames`, all of one size, with each of `codecs` (settings
// such as "zstd:delta=1"), on one thread. Every decoded frame is compared with
// its original before anything is timed. Adds rows of libraries as yardsticks:
// zstd1_raw (zstd level 1 on the raw pixels) always, JPEG-LS and FFV1 where this
// build has them.
//
// Returns {sequence, width, height, frames, codecs: [{name, lossless,
// max_error_mm, rmse_mm, bytes_first, bytes_mean, ratio, encode_ms, decode_ms}]}. Means
// and medians are over all frames but the first, or the only one; a frame's time
// is that of its fastest pass.
//
// Throws Error for an unknown codec, frames of several sizes or none, and a
// lossless codec that changed a pixel.
nlohmann::json bench_depth_sequence(const std::string& sequence_name,
                                    const std::vector<DepthImage>& frames,
                                    const std::vector<std::string>& codecs);

}  // namespace theatron
