// SPDX-License-Identifier: Apache-2.0
// What a user may say to an H.264 encoder, for colour and for depth.
#pragma once

#include <string>

#include "base/options.h"

namespace theatron::video {

struct AvcParams {
    int crf = 20;                      // constant quality: 0 to 51, larger is worse and smaller
    double bitrate_mbit = 0;           // if positive, this rate at 30 frames a second instead
    std::string preset = "ultrafast";  // measured in docs/decisions/optional-h264.md
};

// Takes "crf", "bitrate_mbit" and "preset" out of `options`. `problem` is one
// sentence if the preset is none; other trouble is kept by the options.
AvcParams take_avc_params(Options& options, int usual_crf, std::string& problem);

// The parameters in their one spelling: "crf=20" or "bitrate_mbit=5,preset=veryfast".
std::string spelling(const AvcParams& params);

}  // namespace theatron::video
