// SPDX-License-Identifier: Apache-2.0
// The instruction set of a program's vector kernels, which measurements may hold to a poorer one
// than the machine has.
#pragma once

#include <string>

namespace theatron::cli {

// Environment variable that names the best instruction set that the programs may use, as "AVX2".
// Programs that they start inherit it.
inline constexpr const char* instruction_set_variable = "THEATRON_TARGETS";

// Names of the instruction sets that this machine and this build have, the best first, with ", "
// between them.
std::string known_instruction_sets();
// The best of these: what the kernels of this process run with.
std::string instruction_set_in_use();
// If the variable is set and not empty, the kernels of this process use no better instruction set
// from now on, and a line on the standard error says so; upper and lower case are equal. Throws
// Error, which names those that are there, for another name. Call it before the first kernel runs.
void hold_to_instruction_set();

}  // namespace theatron::cli
