// SPDX-License-Identifier: Apache-2.0
// The frame of every program of the command line: what its main() does before and after its work.
#pragma once

#include <functional>
#include <vector>

#include "sandbox/inside.h"

namespace theatron::cli {

// Serves as one of `readers` where this process was started as that. Else holds
// vector kernels to the instruction set that the environment names, runs `work`, prints an
// exception of it as one sentence, waits until the output is written, and ends the process with
// the code of `work`, or with 1. Call it at the beginning of main().
[[noreturn]] void run_program(int argc, char** argv, const std::vector<sandbox::Reader>& readers,
                              const std::function<int()>& work);

}  // namespace theatron::cli
