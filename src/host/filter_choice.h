// SPDX-License-Identifier: Apache-2.0
// --filter of the host: the filters of each camera, from presets, lines or small
// files that may change while it runs.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "filter/background.h"
#include "filter/chain_settings.h"

namespace theatron::host {

// The filter of a camera for which none is chosen.
inline constexpr const char* usual_filter = "default";

// Settings that can be used at once.
struct LoadedFilter {
    filter::ChainSettings settings;
    std::shared_ptr<const filter::Background> background;  // empty where none is needed
};

// For people: the name of the preset that has this spelling, or else the spelling;
// "unfiltered" where there is none.
std::string shown_filter(const std::string& spelling);

// Throws Error with one sentence if the background was recorded with depth images of another size
// than `depth`, which would leave it without effect.
void check_background(const LoadedFilter& filter, Size depth);

// Says once in the life of the program, to its log, why the processor filters in place of a GPU
// that such settings ask for or would try. From any thread.
void tell_missing_gpu(const filter::ChainSettings& settings);

// A preset, a line as in docs/filters.md, or the name of a JSON file.
class FilterSource {
public:
    explicit FilterSource(std::string text) : text_(std::move(text)) {}

    // Throws Error with one sentence.
    LoadedFilter load();

    // The filter in the file if the file has changed since the last call of load() or
    // changed(). Throws Error if its content is wrong, once for each change.
    std::optional<LoadedFilter> changed();

private:
    std::string text_;
    std::filesystem::path file_;  // empty: text_ is no file
    std::filesystem::file_time_type written_{};
};

// The sources of cameras with these names, from arguments "WHAT" (all cameras) and
// "CAMERA=WHAT" (one, by its number from 0 or its name). Throws Error.
std::vector<FilterSource> filter_sources(const std::vector<std::string>& arguments,
                                         const std::vector<std::string>& cameras,
                                         const std::string& usual);

}  // namespace theatron::host
