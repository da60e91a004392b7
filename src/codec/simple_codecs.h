// SPDX-License-Identifier: Apache-2.0
// The codecs that are pure functions, in the shape of the family.
#pragma once

#include <memory>

#include "codec/depth_codec.h"

namespace theatron::codec {

std::unique_ptr<DepthCodec> make_raw();
std::unique_ptr<DepthCodec> make_rvl();
std::unique_ptr<DepthCodec> make_trvl();
std::unique_ptr<DepthCodec> make_ans(bool delta);

}  // namespace theatron::codec
