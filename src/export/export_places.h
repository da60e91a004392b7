// SPDX-License-Identifier: Apache-2.0
// The places of exports: never among the files of an earlier one.
#pragma once

#include <filesystem>

namespace theatron::exporting {

// The place for the frames of calibration `calibration`, counted from 0: "points", then "points.2"
// and so on; "kinect.2.mkv".
std::filesystem::path place_of(const std::filesystem::path& place, std::size_t calibration);

// Prepare a place: Error with one sentence if an export is there already, unless `overwrite`, which
// removes it and nothing else.
void clear_folder(const std::filesystem::path& folder, bool overwrite);
void clear_file(const std::filesystem::path& file, bool overwrite);

}  // namespace theatron::exporting
