// SPDX-License-Identifier: Apache-2.0
// The calibration beside a folder of pictures (docs/formats/camera_folder.md).
// All functions are safe for untrusted input.
#pragma once

#include <string>
#include <string_view>

#include "capture/json_fields.h"

namespace theatron::capture {

// Reads calibration.json, ours or an Azure Kinect's, for pictures of these
// sizes (colour 0 x 0: none). Without colour camera in the file, colour is
// taken to be aligned with depth.
ParsedCalibration parse_folder_calibration(std::string_view json, Size depth, Size color);

// Reads camera-intrinsics.txt: the nine numbers of a pinhole camera's matrix,
// row by row. Colour is aligned with depth.
ParsedCalibration parse_intrinsics_matrix(std::string_view text, Size depth, Size color);

// The text of a calibration.json that reads as `calibration` again.
std::string write_folder_calibration(const Calibration& calibration);

// What is assumed where nothing is known.
Calibration default_calibration(Size depth, Size color);

}  // namespace theatron::capture
