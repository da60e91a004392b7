// SPDX-License-Identifier: Apache-2.0
// A decorator for any camera: crops its pictures and scales colour. Pixels outside the crop
// cost nothing later.
#pragma once

#include <memory>
#include <string>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

// Options of every kind of camera.
struct CropOptions {
    std::string depth;       // "X:Y:WxH"; empty: all
    std::string color;       // "X:Y:WxH"; "auto": the part that depth sees; "off"; empty: all
    std::string color_size;  // "WxH"; "depth": pixels as wide as depth's; empty: unchanged

    bool any() const {
        return !(depth.empty() && (color.empty() || color == "off") && color_size.empty());
    }
};
CropOptions take_crop_options(Options& options);

inline constexpr const char* crop_help =
    "every camera: crop=X:Y:WxH (part of depth), color_crop=auto|X:Y:WxH|off, "
    "color_size=WxH|depth";

// Wraps `camera`. Throws Error, with one sentence, if a crop is outside the pictures, or a
// size exceeds theirs. A camera's JPEG is cropped without decoding, which moves the top left
// corner up and left to a multiple of 16. Scaled colour becomes pixels.
std::unique_ptr<Camera> make_cropped_camera(std::unique_ptr<Camera> camera,
                                            const CropOptions& options);

}  // namespace theatron::capture
