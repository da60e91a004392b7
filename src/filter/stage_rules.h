// SPDX-License-Identifier: Apache-2.0
// Converts parameters in millimetres to the integers of one camera's kernels.
#pragma once

#include "filter/chain_camera.h"
#include "filter/chain_settings.h"
#include "filter/flying_pixels.h"
#include "filter/holes.h"
#include "filter/kalman.h"
#include "filter/limits.h"
#include "filter/speckles.h"
#include "filter/steady.h"

namespace theatron::filter {

FlyingPixelRule rule_of(const FlyingPixelParams& params, const ChainCamera& camera);
SpeckleRule rule_of(const SpeckleParams& params, const ChainCamera& camera);
HoleRule rule_of(const HoleParams& params, const ChainCamera& camera);
KalmanRule rule_of(const KalmanParams& params, const ChainCamera& camera);
SteadyRule rule_of(const SteadyParams& params, const ChainCamera& camera);

// Narrow the limits.
void narrow(Limits& limits, const RangeParams& params, const ChainCamera& camera);
void narrow(Limits& limits, const BackgroundParams& params, const ChainCamera& camera);

}  // namespace theatron::filter
