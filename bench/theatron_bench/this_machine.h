// SPDX-License-Identifier: Apache-2.0
// Facts of this machine that a benchmark names beside its figures.
#pragma once

#include <string>

namespace theatron::bench {

// The processor, in its maker's words.
std::string processor_name();

// The cores that other programs keep busy, measured for a second.
double cores_of_others();

}  // namespace theatron::bench
