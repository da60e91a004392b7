// SPDX-License-Identifier: Apache-2.0
#include "video/avc_setting.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace theatron::video {
namespace {

constexpr std::array<std::string_view, 4> presets = {"ultrafast", "superfast", "veryfast",
                                                     "faster"};

}  // namespace

AvcParams take_avc_params(Options& options, int usual_crf, std::string& problem) {
    AvcParams params;
    params.crf = options.take_int("crf", usual_crf, 0, 51);
    params.bitrate_mbit = options.take_number("bitrate_mbit", 0, 0.05, 200);
    const std::string preset = options.take("preset", params.preset);
    if (std::find(presets.begin(), presets.end(), preset) == presets.end()) {
        problem = "In '" + options.text() + "', preset must be";
        for (const std::string_view p : presets)
            problem += (p == presets.front()  ? " "
                        : p == presets.back() ? " or "
                                              : ", ") +
                       std::string(p);
        problem += ".";
    } else {
        params.preset = preset;
    }
    params.encoder = options.take("encoder");
    if (!params.encoder.empty() && params.encoder != x264_name && params.encoder != openh264_name)
        problem = "In '" + options.text() + "', encoder must be " + x264_name + " or " +
                  openh264_name + ".";
    const bool has_preset = params.preset != AvcParams().preset;
    if (has_preset && params.encoder == openh264_name)
        problem = "In '" + options.text() + "', openh264 has no presets.";
    if (has_preset)
        params.encoder = x264_name;
    return params;
}

std::string spelling(const AvcParams& params) {
    std::string text = "crf=" + std::to_string(params.crf);
    if (params.bitrate_mbit > 0) {
        char number[32];
        std::snprintf(number, sizeof(number), "bitrate_mbit=%g", params.bitrate_mbit);
        text = number;
    }
    if (params.preset != AvcParams().preset)
        text += ",preset=" + params.preset;
    else if (!params.encoder.empty())
        text += ",encoder=" + params.encoder;
    return text;
}

}  // namespace theatron::video
