// SPDX-License-Identifier: Apache-2.0
// The instruction set of the kernels in a benchmark.
#pragma once

#include <string>

namespace theatron::bench {

// Environment variable that names the best instruction set a benchmark may use, as "AVX2".
inline constexpr const char* targets_variable = "THEATRON_TARGETS";

// Names of the instruction sets that this machine and this build have, the best first, with ", "
// between them.
std::string known_targets();
// The best of these: what the kernels of this process run with.
std::string target_in_use();
// From now on the kernels of this process use no better instruction set than this one; upper and
// lower case are equal. Throws Error, which names those that are there, for another one. Call it
// before the first kernel runs.
void hold_to_target(const std::string& name);

}  // namespace theatron::bench
