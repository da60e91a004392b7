// SPDX-License-Identifier: Apache-2.0
// theatron bench compare
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_compare_bench(CLI::App& bench);

}  // namespace theatron::bench
