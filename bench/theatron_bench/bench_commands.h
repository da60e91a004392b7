// SPDX-License-Identifier: Apache-2.0
// The benchmarks as commands. Each callback measures, and throws Error with one sentence on
// failure.
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_benchmarks(CLI::App& app);

}  // namespace theatron::bench
