// SPDX-License-Identifier: Apache-2.0
// The encoder of automatic colour (video::auto_color): H.264 or JPEG, picture by picture.
#pragma once

#include <atomic>
#include <memory>
#include <string_view>

#include "send/jpeg_budget.h"
#include "video/color_codec.h"

namespace theatron::send {

// The two encodings that automatic colour changes between. That of JPEG is its best one: pictures
// that would take more than JpegBudget allows have a lower quality, or are smaller.
inline constexpr std::string_view auto_h264 = "h264:crf=20", auto_jpeg = "jpeg:quality=85";

// The codec in use now, shared by the encoders of all cameras. From any thread.
using AutoColor = std::atomic<bool>;  // true: H.264

// EncodedColor::codec is the codec of each picture. The first picture after a change is a key
// frame. After a failure of the H.264 encoder all pictures are JPEG. They keep
// these limits.
std::unique_ptr<video::ColorEncoder> make_auto_encoder(std::shared_ptr<const AutoColor> is_h264,
                                                       const JpegLimits& limits);

}  // namespace theatron::send
