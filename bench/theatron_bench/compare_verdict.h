// SPDX-License-Identifier: Apache-2.0
// The verdict on Theatron's picture in plain sentences that the figures choose.
#pragma once

#include <string>
#include <vector>

#include "compare.h"

namespace theatron::bench {

// From this share of the close-up on that is missing, in percent, the wound is not to be judged
// from the picture; below `few_missing_percent` nothing is said against it.
inline constexpr double many_missing_percent = 5, few_missing_percent = 1;

// Empty without a measured close-up of Theatron.
std::vector<std::string> compare_verdict(const Compared& compared);

}  // namespace theatron::bench
