// SPDX-License-Identifier: Apache-2.0
#include "camera_frames.h"

#include <optional>

#include "base/error.h"
#include "filter/color_registration.h"
#include "video/color_codec.h"

namespace theatron::bench {
namespace {

constexpr Duration patience = 20s;  // for a camera that delivers nothing

ColorImage decoded(const ColorData& color, video::ColorDecoder& jpeg, const std::string& camera) {
    if (!color.is_jpeg())
        return color.pixels;
    if (jpeg.submit(color.jpeg, 0) == Status::ok)
        if (auto result = jpeg.poll())
            return std::move(result->image);
    throw Error("A colour picture of the camera '" + camera + "' is damaged.");
}

}  // namespace

CameraFrames load_camera_frames(const std::string& specification, int max_frames,
                                const capture::Progress& progress) {
    const auto camera = capture::open_camera(specification, progress);
    (void)camera->skip_none();
    CameraFrames result{specification, camera->info().name, camera->info().calibration, {}, {}};
    const auto jpeg = video::make_color_decoder(video::ColorCodecId::jpeg);
    std::vector<DepthImage> without_color;
    while (int(result.depth.size() + without_color.size()) < max_frames) {
        const capture::Capture next = camera->next(patience);
        if (next.kind == capture::Capture::Kind::nothing)
            throw Error("The camera '" + specification + "' delivers no pictures.");
        if (next.kind == capture::Capture::Kind::failed)
            throw Error(next.problem);
        if (next.kind == capture::Capture::Kind::end)
            break;
        const Frame& frame = *next.frame;
        if (frame.depth.empty())
            continue;
        if (frame.color.empty()) {
            without_color.push_back(frame.depth);
            continue;
        }
        result.depth.push_back(frame.depth);
        result.color.push_back(decoded(frame.color, *jpeg, specification));
    }
    if (result.depth.empty())
        result.depth = std::move(without_color);
    if (result.depth.empty())
        throw Error("The camera '" + specification + "' has no depth pictures.");
    return result;
}

std::vector<ColorImage> registered_colors(const CameraFrames& frames) {
    std::vector<ColorImage> pictures;
    if (frames.color.empty() || frames.calibration.color.size.area() == 0)
        return pictures;
    Calibration calibration = frames.calibration;
    calibration.color = scaled(calibration.color, frames.color.front().size);
    filter::ColorRegistration registration(calibration);
    Image<std::uint8_t> seen(calibration.depth.size);
    for (std::size_t i = 0; i < frames.depth.size(); ++i) {
        pictures.emplace_back(calibration.depth.size);
        registration.apply(frames.depth[i].view(), frames.color[i].view(), pictures.back().view(),
                           seen.view());
    }
    return pictures;
}

}  // namespace theatron::bench
