// SPDX-License-Identifier: Apache-2.0
// How alike two pictures look: SSIM (Wang and others, 2004).
#pragma once

#include "image/view.h"

namespace theatron::bench {

// The mean over windows of 8x8 pixels, four apart, of the brightness; 1 for equal
// pictures. Both have one size, at least 8x8.
double ssim(ColorView a, ColorView b);

}  // namespace theatron::bench
