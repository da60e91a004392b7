// SPDX-License-Identifier: Apache-2.0
#include "video/color_setting.h"

#include "base/options.h"
#include "video/color_codec.h"

namespace theatron::video {
namespace {

ParsedColorSetting refused(std::string problem) {
    return {.setting = {}, .problem = std::move(problem)};
}

// Cameras deliver JPEG of quality 85 to 95. A lower quality is a request for fewer bytes.
bool usually_passes(int quality) {
    return quality >= JpegParams().quality;
}

}  // namespace

std::vector<std::string> color_codec_names() {
    return {"raw", "jpeg", "h264"};
}

JpegParams take_jpeg_params(Options& options) {
    JpegParams params;
    params.quality = options.take_int("quality", params.quality, 1, 100);
    const std::string subsampling = options.take("subsampling", "420");
    params.subsampling_known = subsampling == "420" || subsampling == "444";
    params.halve_chroma = subsampling != "444";
    params.pass = options.take_flag("pass", usually_passes(params.quality));
    return params;
}

AvcParams take_h264_params(Options& options, std::string& problem) {
    constexpr int usual_crf = 20;
    return take_avc_params(options, usual_crf, problem);
}

ParsedColorSetting parse_color_setting(std::string_view text) {
    Options options = Options::parse(text);
    ColorSetting setting;
    if (options.kind() == "raw") {
        setting = {ColorCodecId::raw, "raw"};
    } else if (options.kind() == "jpeg") {
        const JpegParams params = take_jpeg_params(options);
        if (!params.subsampling_known)
            return refused("In '" + std::string(text) + "', subsampling must be 420 or 444.");
        setting = {ColorCodecId::jpeg, "jpeg:quality=" + std::to_string(params.quality)};
        if (!params.halve_chroma)
            setting.text += ",subsampling=444";
        if (params.pass != usually_passes(params.quality))
            setting.text += params.pass ? ",pass=1" : ",pass=0";
    } else if (options.kind() == "h264") {
        std::string problem;
        setting = {ColorCodecId::h264, "h264:" + spelling(take_h264_params(options, problem))};
        if (!problem.empty())
            return refused(std::move(problem));
    } else if (options.problem().empty() || !options.kind().empty()) {
        std::string names;
        for (const std::string& name : color_codec_names())
            names += (names.empty() ? "" : ", ") + name;
        return refused("There is no colour codec '" + options.kind() + "'; there are " + names +
                       ".");
    }
    if (options.problem().empty() && !options.value().empty())
        return refused("In '" + std::string(text) + "', '" + options.value() +
                       "' is not a key=value pair.");
    if (std::string problem = options.problem(); !problem.empty())
        return refused(std::move(problem));
    return {.setting = std::move(setting), .problem = {}};
}

}  // namespace theatron::video
