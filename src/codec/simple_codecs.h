// SPDX-License-Identifier: Apache-2.0
// Adapters from the pure codec functions to DepthCodec.
#pragma once

#include <memory>

#include "codec/depth_codec.h"

namespace theatron::codec {

std::unique_ptr<DepthCodec> make_raw();
std::unique_ptr<DepthCodec> make_rvl();
std::unique_ptr<DepthCodec> make_trvl();
std::unique_ptr<DepthCodec> make_ans(bool delta);

}  // namespace theatron::codec
