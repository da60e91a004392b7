// SPDX-License-Identifier: Apache-2.0
// The verdict on Theatron's picture in plain sentences that the figures choose.
#pragma once

#include <string>
#include <vector>

#include "compare.h"

namespace theatron::bench {

// Shares of the surfaces close to the wound, in percent. From many_percent on that are shown
// wrongly the wound is not to be judged from the picture; below few_percent nothing is said against
// it, and two ways whose shares differ by less show as much.
inline constexpr double many_percent = 5, few_percent = 1;

// Empty where Theatron's picture of the wound was not measured.
std::vector<std::string> compare_verdict(const Compared& compared);

}  // namespace theatron::bench
