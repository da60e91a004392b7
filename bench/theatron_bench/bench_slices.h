// SPDX-License-Identifier: Apache-2.0
// `theatron bench slices`: the time from a change of the slice to its finished picture.
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_slices_bench(CLI::App& bench);

}  // namespace theatron::bench
