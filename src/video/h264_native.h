// SPDX-License-Identifier: Apache-2.0
// Colour as H.264 (docs/formats/color_h264.md). Native builds only.
#pragma once

#include <memory>

#include "video/color_codec.h"

namespace theatron::video {

// Throw Error where this machine has no such library.
std::unique_ptr<ColorEncoder> make_h264_encoder(const ColorSetting& setting);
std::unique_ptr<ColorDecoder> make_h264_decoder();

}  // namespace theatron::video
