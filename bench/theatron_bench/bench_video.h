// SPDX-License-Identifier: Apache-2.0
// Video codecs of libavcodec behind the interfaces of our colour codecs, as yardsticks: VP8, VP9
// and AV1 with constant quality, one picture in, one picture out.
#pragma once

#include <memory>
#include <string>

#include "video/color_codec.h"

namespace theatron::bench {

// "vp8:q=20", "vp9:q=30" (libvpx), "av1:q=30" (libaom), "svtav1:q=30": q is the library's measure
// of quality, 4 to 63.
bool is_video_yardstick(const std::string& codec);

// They take pixels or a camera's JPEG. Throw Error where libavcodec has no such library.
std::unique_ptr<video::ColorEncoder> make_video_encoder(const std::string& codec);
std::unique_ptr<video::ColorDecoder> make_video_decoder(const std::string& codec);

}  // namespace theatron::bench
