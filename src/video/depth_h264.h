// SPDX-License-Identifier: Apache-2.0
// Depth as grey H.264 video (docs/formats/depth_h264.md): lossy, small, for
// comparison and for slow links. The set of valid pixels is kept exactly; their
// values become 1024 levels of equal ratio and are encoded by x264.
#pragma once

#include <memory>
#include <string>

#include "codec/depth_codec.h"
#include "video/avc_setting.h"

namespace theatron::video {

struct DepthH264Params {
    AvcParams avc{.crf = 8, .bitrate_mbit = 0, .preset = AvcParams().preset};
    // Values outside are coded as the nearest inside. 0 < near < far. A far end beyond
    // every reading costs little: levels are of equal ratio.
    std::uint16_t near_value = 150, far_value = 65535;
};

bool has_depth_h264();
std::string missing_depth_h264_encoder();
std::string missing_depth_h264_decoder();

// Unlike other depth codecs it has a state, which is the video library's: frames
// are encoded and decoded in the order of the stream, each referring to the one
// before. Any other reference is missing_reference to the decoder, and makes the
// encoder write a key frame. If the encoder is missing nothing is encoded (0 bytes).
std::unique_ptr<codec::DepthCodec> make_depth_h264(const DepthH264Params& params);

}  // namespace theatron::video
