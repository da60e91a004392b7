// SPDX-License-Identifier: Apache-2.0
#include "host/codec_steps.h"

#include "base/options.h"
#include "video/avc_setting.h"
#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace theatron::host {
namespace {

using session::CodecSteps;

// Size of a picture by its quality or rate factor, relative to the standard one:
// table-person and azure-nfov sequences.
struct Size {
    int at = 0;
    double size = 1;
};
constexpr Size jpeg_steps[] = {{60, 0.52}, {40, 0.39}, {20, 0.25}};
constexpr Size jpeg_sizes[] = {{97, 2.6},  {93, 1.7},  {88, 1.2},  {84, 1.0},  {76, 0.84},
                               {66, 0.65}, {56, 0.52}, {36, 0.39}, {16, 0.25}, {0, 0.15}};
// The size of uncompressed colour on the same scale.
constexpr double raw_size = 18;
// Added to the rate factor of H.264; six halve the bits.
constexpr Size h264_steps[] = {{6, 0.5}, {12, 0.25}};
constexpr int coarsest_crf = 40;

// Loss outside the region of interest: invisible in a cloud of points, and growing
// with the noise of a time-of-flight sensor.
constexpr const char* loss = "max_error_mm=4,noise_scaled=2";

double jpeg_size(int quality) {
    for (const Size& known : jpeg_sizes)
        if (quality >= known.at)
            return known.size;
    return 1;
}

std::string with(const std::string& codec, const std::string& parameter) {
    return codec + (codec.find(':') == std::string::npos ? ":" : ",") + parameter;
}

CodecSteps::Layered layered(const std::string& depth) {
    const auto own = video::parse_depth_setting(depth);
    if (own.setting.layers > 1)
        return {depth, false, own.setting.layers == codec::max_layers};
    const auto wanted =
        video::parse_depth_setting(with(depth, "layers=" + std::to_string(codec::max_layers)));
    if (!wanted.problem.empty())
        return {depth, !video::make_depth_codec(own.setting)->temporal(), false};
    return {wanted.setting.text, false, true};
}

std::vector<CodecSteps::Coarser> coarser_h264(Options options) {
    std::string problem;
    const video::AvcParams params =
        video::take_avc_params(options, video::AvcParams().crf, problem);
    std::vector<CodecSteps::Coarser> steps;
    for (const Size& step : h264_steps) {
        video::AvcParams coarse = params;
        coarse.crf += step.at;
        coarse.bitrate_mbit *= step.size;
        const auto parsed = video::parse_color_setting("h264:" + video::spelling(coarse));
        if (parsed.problem.empty() && coarse.crf <= coarsest_crf)
            steps.push_back({parsed.setting.text, step.size});
    }
    return steps;
}

std::vector<CodecSteps::Coarser> coarser(const std::string& color) {
    Options options = Options::parse(color);
    if (options.kind() == "h264")
        return coarser_h264(std::move(options));
    const bool jpeg = options.kind() == "jpeg";
    const int quality = jpeg ? options.take_int("quality", 85, 1, 100) : 100;
    const double whole = jpeg ? jpeg_size(quality) : raw_size;
    std::vector<CodecSteps::Coarser> steps;
    for (const Size& step : jpeg_steps)
        if (step.at < quality)
            steps.push_back(
                {video::parse_color_setting("jpeg:quality=" + std::to_string(step.at)).setting.text,
                 step.size / whole});
    return steps;
}

std::string lossy_outside_region(const std::string& depth) {
    const auto own = video::parse_depth_setting(depth);
    if (own.setting.id != codec::DepthCodecId::strata ||
        !video::make_depth_codec(own.setting)->lossless())
        return "";
    return video::parse_depth_setting(with(depth, loss)).setting.text;
}

}  // namespace

session::CodecSteps codec_steps(std::shared_ptr<const send::AutoColor> auto_is_h264) {
    const auto now = [auto_is_h264](const std::string& color) {
        return color != video::auto_color
                   ? color
                   : std::string(*auto_is_h264 ? send::auto_h264 : send::auto_jpeg);
    };
    CodecSteps steps;
    steps.layered = layered;
    steps.coarser = [now](const std::string& color) { return coarser(now(color)); };
    steps.refers = [](std::uint8_t codec) {
        return codec == std::uint8_t(video::ColorCodecId::h264);
    };
    steps.lossy_outside_region = lossy_outside_region;
    return steps;
}

}  // namespace theatron::host
