// SPDX-License-Identifier: Apache-2.0
// Parameters of an H.264 encoder that a user can set, for colour and for depth.
#pragma once

#include <string>

#include "base/options.h"

namespace theatron::video {

inline constexpr const char *x264_name = "x264", *openh264_name = "openh264";

struct AvcParams {
    int crf = 20;                      // constant quality: 0 to 51, larger is worse and smaller
    double bitrate_mbit = 0;           // if positive, this rate at 30 frames a second instead
    std::string preset = "ultrafast";  // of x264; measured in docs/decisions/optional-h264.md
    std::string encoder;               // x264_name or openh264_name; empty: the best there is
};

// Takes "crf", "bitrate_mbit", "preset" and "encoder" out of `options`. `problem` is one
// sentence if preset or encoder is none; other trouble is kept by the options.
AvcParams take_avc_params(Options& options, int usual_crf, std::string& problem);

// The parameters in canonical spelling: "crf=20" or "bitrate_mbit=5,preset=veryfast".
std::string spelling(const AvcParams& params);

}  // namespace theatron::video
