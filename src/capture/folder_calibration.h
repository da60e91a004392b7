// SPDX-License-Identifier: Apache-2.0
// The calibration beside a folder of pictures (docs/formats/camera_folder.md).
// All functions are safe for untrusted input.
#pragma once

#include <string>
#include <string_view>

#include "capture/json_fields.h"

namespace theatron::capture {

// Parses calibration.json, our format or an Azure Kinect's, for pictures of these sizes
// (colour 0 x 0: none). Without a colour camera in the file, colour is assumed to be aligned
// with depth.
ParsedCalibration parse_folder_calibration(std::string_view json, Size depth, Size color);

// Parses camera-intrinsics.txt: the nine numbers of a pinhole camera's matrix, row by row.
// Colour is assumed to be aligned with depth.
ParsedCalibration parse_intrinsics_matrix(std::string_view text, Size depth, Size color);

// The text of a calibration.json that parses to `calibration`.
std::string write_folder_calibration(const Calibration& calibration);

// The calibration assumed for a folder without one.
Calibration default_calibration(Size depth, Size color);

}  // namespace theatron::capture
