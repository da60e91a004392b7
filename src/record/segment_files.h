// SPDX-License-Identifier: Apache-2.0
// Which files beside a recording may hold its other segments.
#pragma once

#include <filesystem>
#include <vector>

namespace theatron::record {

// By name alone, in the order of their numbers: of "a.mkv" those named "a.002.mkv", of "a.003.mkv"
// those named "a.004.mkv" and so on.
std::vector<std::filesystem::path> files_of_later_segments(const std::filesystem::path& file);
// The same of earlier ones: of "a.003.mkv", "a.mkv" and "a.002.mkv".
std::vector<std::filesystem::path> files_of_earlier_segments(const std::filesystem::path& file);

}  // namespace theatron::record
