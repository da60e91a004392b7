// SPDX-License-Identifier: Apache-2.0
// The places of exports: never among the files of an earlier one.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace theatron::exporting {

// The place for the frames of calibration `calibration`, counted from 0: "points", then "points.2"
// and so on; "kinect.2.mkv".
std::filesystem::path place_of(const std::filesystem::path& place, std::size_t calibration);

// Beside exported frames: their times.
inline constexpr const char* times_name = "times.csv";

// Prepares a folder: Error with one sentence if an export is there already, unless `overwrite`,
// which removes it and nothing else.
void clear_folder(const std::filesystem::path& folder, bool overwrite);

// Error with one sentence if the file is there already, unless `overwrite`, or is a recording in
// use.
void require_free(const std::filesystem::path& file, bool overwrite);
// The same for all files that replace_files() writes for `count` calibrations, its drafts included.
// None of them may be a file of `sources`.
void require_free(const std::filesystem::path& file, std::size_t count, bool overwrite,
                  const std::vector<std::filesystem::path>& sources);

// Calls `write(draft, n)` for calibrations 0 to `count` - 1, then gives the drafts their names.
// If a call throws, the files of an earlier export are as before. Other files stay.
void replace_files(const std::filesystem::path& file, std::size_t count,
                   const std::function<void(const std::filesystem::path&, std::size_t)>& write);

}  // namespace theatron::exporting
