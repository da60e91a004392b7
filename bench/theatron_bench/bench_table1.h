// SPDX-License-Identifier: Apache-2.0
// `theatron bench table1`: the paper's Table 1, row by row, beside measurements of this machine.
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_table1_bench(CLI::App& bench);

}  // namespace theatron::bench
