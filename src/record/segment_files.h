// SPDX-License-Identifier: Apache-2.0
// Finds the files beside a recording that may hold its other segments.
#pragma once

#include <filesystem>
#include <vector>

namespace theatron::record {

// By name alone, in the order of their numbers: for "a.mkv" the files "a.002.mkv" and so on, for
// "a.003.mkv" the files "a.004.mkv" and so on.
std::vector<std::filesystem::path> files_of_later_segments(const std::filesystem::path& file);
// The same for earlier segments: for "a.003.mkv", "a.mkv" and "a.002.mkv".
std::vector<std::filesystem::path> files_of_earlier_segments(const std::filesystem::path& file);
// All other files in the folder of `file` with its ending: of segments that were renamed, and of
// other recordings. In the order of their names.
std::vector<std::filesystem::path> files_of_other_names(const std::filesystem::path& file);
// True if another program records into the file or plays it.
bool is_in_use(const std::filesystem::path& file);

}  // namespace theatron::record
