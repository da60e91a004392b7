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

// The work beside the filters' own: everything (references, which are also timed, zstd and other
// yardsticks), references once to check the pixels of every stage, or nothing.
enum class FilterCompany { everything, check, nothing };

// {width, height, target, stages: [{name, variant, ms}], chain: [{variant, ms, zstd1_ms,
// of_zstd1}]}: medians over the clip's frames of the fastest of several passes, on one thread.
// `target` is the instruction set. zstd level 1 compresses the same frames in turns with a chain;
// `of_zstd1` is the chain's share of its time. References have neither. Before the timing, the
// pixels of every stage are compared with those of its reference. `variant` is `simd`, `reference`
// or a library's name; in `chain` it is the name of the chain, with `/reference` for the sum of its
// stages' references. `names`: presets, with further filters or without. Without
// FilterCompany::everything there are only the filters' own times; with `nothing` the caller has
// had the same frames checked.
nlohmann::json bench_filter(const std::vector<DepthImage>& frames,
                            const std::vector<std::string>& names = {"paper", "default",
                                                                     "default+speckles", "stereo"},
                            FilterCompany company = FilterCompany::everything);

// The accuracy of a chain on scenes with known depth. Keys: docs/filters.md. `stereo`: the scenes
// are seen by a stereo camera instead of a time-of-flight camera.
nlohmann::json filter_quality(const filter::ChainSettings& settings, bool stereo = false);

// The accuracy on one clip without annotations: errors, stability, ghosts. `background` is the
// clip's recorded empty scene, or null.
nlohmann::json filter_quality_of_clip(const filter::ChainSettings& settings, const FilterClip& clip,
                                      const filter::Background* background = nullptr);

// The size and the flicker of a recorded sequence behind a chain: {filters, scenes: [{scene,
// kb_per_frame, still, still_sigma_mm, still_changes, changes, flips, valid}]}. `kb_per_frame` is
// that of lossless Strata behind the first frame. Pixels that are measured in nine of ten frames
// and stay near the median of these are still; the selection does not depend on the chain. Shares
// are of these pixels or of all, per frame.
nlohmann::json filter_quality_of_recording(const filter::ChainSettings& settings,
                                           const std::string& scene,
                                           const std::vector<DepthImage>& measured);

}  // namespace theatron::bench
