// SPDX-License-Identifier: Apache-2.0
#include "video/depth_codecs.h"

#include <algorithm>

#include "base/options.h"
#include "video/depth_h264.h"

namespace theatron::video {
namespace {

using codec::DepthCodecId;

DepthH264Params take_params(Options& options, std::string& problem) {
    DepthH264Params params;
    params.avc = take_avc_params(options, params.avc.crf, problem);
    params.near_value = std::uint16_t(options.take_int("near", params.near_value, 1, 65534));
    params.far_value = std::uint16_t(options.take_int("far", params.far_value, 2, 65535));
    if (problem.empty())
        problem = options.problem();
    if (problem.empty() && !options.value().empty())
        problem = "In '" + options.text() + "', '" + options.value() + "' is not a key=value pair.";
    if (problem.empty() && params.avc.encoder == openh264_name)
        problem = "In '" + options.text() + "', encoder must be x264: depth has ten bits.";
    if (problem.empty() && params.near_value >= params.far_value)
        problem = "In '" + options.text() + "', near must be less than far.";
    return params;
}

}  // namespace

std::vector<std::string> depth_codec_names() {
    std::vector<std::string> names = codec::depth_codec_names();
    if (has_depth_h264())
        names.emplace_back("h264");
    return names;
}

codec::ParsedDepthSetting parse_depth_setting(std::string_view text) {
    Options options = Options::parse(text);
    codec::ParsedDepthSetting parsed;
    const std::vector<std::string> names = depth_codec_names();
    if (std::find(names.begin(), names.end(), options.kind()) == names.end()) {
        parsed.problem = "The depth codec '" + options.kind() + "' does not exist; choose one of: ";
        for (const std::string& name : names)
            parsed.problem += (name == names.front() ? "" : ", ") + name;
        parsed.problem += ".";
        return parsed;
    }
    if (options.kind() != "h264")
        return codec::parse_depth_setting(text);
    const DepthH264Params params = take_params(options, parsed.problem);
    if (!parsed.problem.empty())
        return parsed;
    parsed.setting = {DepthCodecId::h264, "h264:" + spelling(params.avc), 1};
    if (params.near_value != DepthH264Params().near_value)
        parsed.setting.text += ",near=" + std::to_string(params.near_value);
    if (params.far_value != DepthH264Params().far_value)
        parsed.setting.text += ",far=" + std::to_string(params.far_value);
    return parsed;
}

std::string missing_depth_encoder(const codec::DepthSetting& setting) {
    return setting.id == DepthCodecId::h264 ? missing_depth_h264_encoder() : "";
}

std::string missing_depth_decoder(const codec::DepthSetting& setting) {
    return setting.id == DepthCodecId::h264 ? missing_depth_h264_decoder() : "";
}

std::unique_ptr<codec::DepthCodec> make_depth_codec(const codec::DepthSetting& setting) {
    if (setting.id != DepthCodecId::h264)
        return codec::make_depth_codec(setting);
    Options options = Options::parse(setting.text);
    std::string problem;
    return make_depth_h264(take_params(options, problem));
}

codec::DepthStreamEncoder make_depth_encoder(const codec::DepthSetting& setting) {
    return codec::DepthStreamEncoder(video::make_depth_codec(setting), setting.layers);
}

codec::DepthStreamDecoder make_depth_decoder(const codec::DepthSetting& setting) {
    return codec::DepthStreamDecoder(video::make_depth_codec(setting), setting.layers);
}

}  // namespace theatron::video
