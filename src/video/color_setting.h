// SPDX-License-Identifier: Apache-2.0
// The parameters inside a colour setting's text.
#pragma once

#include "base/options.h"
#include "video/avc_setting.h"

namespace theatron::video {

struct JpegParams {
    int quality = 85;               // 1 to 100
    bool halve_chroma = true;       // 4:2:0, otherwise 4:4:4
    bool subsampling_known = true;  // false if the text asked for another one
    bool pass = true;               // a camera's own JPEG goes through untouched
};

// Takes the keys of "jpeg" out of `options`, which keeps the first problem with them.
JpegParams take_jpeg_params(Options& options);

// Takes the keys of "h264"; `problem` as for take_avc_params.
AvcParams take_h264_params(Options& options, std::string& problem);

}  // namespace theatron::video
