// SPDX-License-Identifier: Apache-2.0
// `theatron bench face`: the fit of a morphable head, the network that tells emotions, and the time
// that both take.
#pragma once

#include <CLI/CLI.hpp>

namespace theatron::bench {

void add_face_bench(CLI::App& bench);

}  // namespace theatron::bench
