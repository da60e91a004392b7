// SPDX-License-Identifier: Apache-2.0
// theatron bench filter: time of each filter, and its accuracy against ground truth.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench_filter_scenes.h"
#include "filter/background.h"
#include "filter/chain_settings.h"

namespace theatron::bench {

// Adds `filter` to the benchmarks.
void add_filter_bench(CLI::App& bench);

// {width, height, stages: [{name, variant, ms}], chain: [{variant, ms}]}: medians over the
// clip's frames of the fastest of several passes, on one thread. Before the timing, the pixels
// of every stage are compared with those of its reference. `variant` is `simd`, `reference` or
// a library's name; in `chain` it is the name of the chain, with `/reference` for the sum of
// its stages' references.
nlohmann::json bench_filter(const std::vector<DepthImage>& frames);

// The accuracy of a chain on scenes with known depth. Keys: docs/filters.md.
nlohmann::json filter_quality(const filter::ChainSettings& settings);

// The accuracy on one clip without annotations: errors, stability, ghosts. `background` is the
// clip's recorded empty scene, or null.
nlohmann::json filter_quality_of_clip(const filter::ChainSettings& settings, const FilterClip& clip,
                                      const filter::Background* background = nullptr);

}  // namespace theatron::bench
