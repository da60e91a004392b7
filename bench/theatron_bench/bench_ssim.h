// SPDX-License-Identifier: Apache-2.0
// The similarity of two pictures: SSIM (Wang et al., 2004).
#pragma once

#include "image/view.h"

namespace theatron::bench {

// The mean SSIM of the brightness over windows of 8x8 pixels, four apart; 1 for equal pictures.
// Both have the same size, at least 8x8.
double ssim(ColorView a, ColorView b);

}  // namespace theatron::bench
