// SPDX-License-Identifier: Apache-2.0
// Browsers decode neither grey nor ten-bit H.264.
#include "video/depth_h264.h"

namespace theatron::video {

bool has_depth_h264() {
    return false;
}
std::string missing_depth_h264_encoder() {
    return "The web build has no depth codec 'h264'.";
}
std::string missing_depth_h264_decoder() {
    return missing_depth_h264_encoder();
}
std::unique_ptr<codec::DepthCodec> make_depth_h264(const DepthH264Params&) {
    return nullptr;
}

}  // namespace theatron::video
