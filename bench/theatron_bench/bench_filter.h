// SPDX-License-Identifier: Apache-2.0
// theatron bench filter: how long each filter takes, and what it does to the truth.
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

// {width, height, stages: [{name, variant, ms}], chain: [{variant, ms}]}: medians
// over the clip's frames of the fastest of several passes, on one thread. Every
// stage's pixels are compared with those of its reference first. `variant` is
// `simd`, `reference` or a library's name; of `chain`, the name of the chain, with
// `/reference` for the sum of its stages' references.
nlohmann::json bench_filter(const std::vector<DepthImage>& frames);

// What a chain makes of scenes with known depth. Keys: docs/filters.md.
nlohmann::json filter_quality(const filter::ChainSettings& settings);

// The same for one clip without markings: errors, steadiness, ghosts. `background`: the
// clip's recorded empty scene, or null.
nlohmann::json filter_quality_of_clip(const filter::ChainSettings& settings, const FilterClip& clip,
                                      const filter::Background* background = nullptr);

}  // namespace theatron::bench
