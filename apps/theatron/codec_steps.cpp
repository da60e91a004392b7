// SPDX-License-Identifier: Apache-2.0
#include "codec_steps.h"

#include "base/options.h"
#include "codec/depth_codec.h"
#include "video/color_codec.h"

namespace theatron::app {
namespace {

// Size of a JPEG picture by its quality, relative to quality 85: table-person and
// azure-nfov sequences, 4:2:0.
struct QualitySize {
    int quality;
    double size;
};
constexpr QualitySize jpeg_steps[] = {{60, 0.52}, {40, 0.39}, {20, 0.25}};
constexpr QualitySize jpeg_sizes[] = {{97, 2.6},  {93, 1.7},  {88, 1.2},  {84, 1.0},  {76, 0.84},
                                      {66, 0.65}, {56, 0.52}, {36, 0.39}, {16, 0.25}, {0, 0.15}};
// Uncompressed colour, likewise.
constexpr double raw_size = 18;

double jpeg_size(int quality) {
    for (const QualitySize& known : jpeg_sizes)
        if (quality >= known.quality)
            return known.size;
    return 1;
}

session::CodecSteps::Layered layered(const std::string& depth) {
    const auto own = codec::parse_depth_setting(depth);
    if (own.setting.layers > 1)
        return {depth, false, own.setting.layers == codec::max_layers};
    const std::string wanted = depth + (depth.find(':') == std::string::npos ? ":" : ",") +
                               "layers=" + std::to_string(codec::max_layers);
    const auto parsed = codec::parse_depth_setting(wanted);
    // A codec that refuses layers refers to no other frame.
    if (!parsed.problem.empty())
        return {depth, true, false};
    return {parsed.setting.text, false, true};
}

std::vector<session::CodecSteps::Coarser> coarser(const std::string& color) {
    Options options = Options::parse(color);
    const bool jpeg = options.kind() == "jpeg";
    if (!jpeg && options.kind() != "raw")
        return {};
    const int quality = jpeg ? options.take_int("quality", 85, 1, 100) : 100;
    const double whole = jpeg ? jpeg_size(quality) : raw_size;
    std::vector<session::CodecSteps::Coarser> steps;
    for (const QualitySize& step : jpeg_steps)
        if (step.quality < quality)
            steps.push_back(
                {video::parse_color_setting("jpeg:pass=0,quality=" + std::to_string(step.quality))
                     .setting.text,
                 step.size / whole});
    return steps;
}

}  // namespace

session::CodecSteps codec_steps() {
    session::CodecSteps steps;
    steps.layered = layered;
    steps.coarser = coarser;
    return steps;
}

}  // namespace theatron::app
