// SPDX-License-Identifier: Apache-2.0
// Any camera with a part of its pictures, and colour in another size. What is
// not sent costs nothing.
#pragma once

#include <memory>
#include <string>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

// The keys that every kind of camera understands.
struct CropOptions {
    std::string depth;       // "X:Y:WxH"; empty: all
    std::string color;       // "X:Y:WxH", "auto": what the depth camera sees, "off" or empty: all
    std::string color_size;  // "WxH", "depth": pixels as wide as depth's; empty: as it is

    bool any() const {
        return !(depth.empty() && (color.empty() || color == "off") && color_size.empty());
    }
};
CropOptions take_crop_options(Options& options);

inline constexpr const char* crop_help =
    "every camera: crop=X:Y:WxH (part of depth), color_crop=auto|X:Y:WxH|off, "
    "color_size=WxH|depth";

// `camera` behind the options. Throws Error, with one sentence, if a part lies
// outside the pictures, or a size is larger than they are. A camera's JPEG is
// cropped without decoding it, which moves the corner of the part up and left to
// a multiple of 16; scaled colour becomes pixels.
std::unique_ptr<Camera> make_cropped_camera(std::unique_ptr<Camera> camera,
                                            const CropOptions& options);

}  // namespace theatron::capture
