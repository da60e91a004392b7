// SPDX-License-Identifier: Apache-2.0
// `theatron bench capacity`: the cameras and viewers that a machine can carry as a host.
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_capacity_bench(CLI::App& bench);

}  // namespace theatron::bench
