// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/ids.h"

namespace theatron {

// Frame numbers wrap; a difference of half the range or more means "older".
inline std::int32_t frames_after(FrameNumber a, FrameNumber b) {
    return std::int32_t(a - b);
}

}  // namespace theatron
