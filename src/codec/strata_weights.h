// SPDX-License-Identifier: Apache-2.0
// Finds the weights of Strata's linear predictor for one frame.
#pragma once

#include "codec/strata_kernel.h"

namespace theatron::codec::strata {

// The weights that predict best, in least squares, where depth is smooth; for
// `taps` taps, the others 0.
Weights solve(const Equations& equations, int taps);

}  // namespace theatron::codec::strata
