// SPDX-License-Identifier: Apache-2.0
// Measures the colour codecs on a sequence of pictures: sizes, times, similarity.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "image/image.h"

namespace theatron::bench {

// As bench_depth_sequence, for colour: {sequence,width,height,frames,codecs:[{name,lossless,
// psnr_db,bytes_first,bytes_mean,ratio,encode_ms,decode_ms}]}. psnr_db is null for lossless
// results. Yardsticks: zstd1_raw compresses the raw pixels with zstd level 1; each JPEG setting
// has a row libjpeg_turbo with the same parameters; `codecs` may name those of bench_video.h.
// With `camera_noise`, the standard deviation of a mid-grey pixel in steps of 255, the codecs get
// the frames with noise, as JPEG of quality 90. All results, and that JPEG itself (row
// camera_jpeg), are compared with the frames. Throws Error.
nlohmann::json bench_color_sequence(const std::string& sequence_name,
                                    const std::vector<ColorImage>& frames,
                                    const std::vector<std::string>& codecs,
                                    double camera_noise = 0);

}  // namespace theatron::bench
