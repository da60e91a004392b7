// SPDX-License-Identifier: Apache-2.0
// `theatron bench relay`: what a host and its relay need for many receivers.
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_relay_bench(CLI::App& bench);

}  // namespace theatron::bench
