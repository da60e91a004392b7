// SPDX-License-Identifier: Apache-2.0
// The weights of Strata's linear predictor for one frame.
#pragma once

#include "codec/strata_kernel.h"

namespace theatron::codec::strata {

// The weights with the least squared error, from the first `taps` taps; the others
// are 0.
Weights solve(const Equations& equations, int taps);

}  // namespace theatron::codec::strata
