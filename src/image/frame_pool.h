// SPDX-License-Identifier: Apache-2.0
// Frames whose memory is used again (base/pool.h).
#pragma once

#include "base/pool.h"
#include "image/frame.h"

namespace theatron {

using FramePool = Pool<Frame>;

}  // namespace theatron
