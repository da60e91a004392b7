// SPDX-License-Identifier: Apache-2.0
// The factory calibration that every Azure Kinect carries and its recordings
// contain (a JSON text with "CalibrationInformation"), for the modes in which
// the camera can run.
//
// The text describes the whole sensors in normalised units, with (0, 0) in the
// corner of the first pixel. Each mode bins or scales the sensor and cuts out a
// part. The modes' numbers are facts of the device, as in the camera's SDK
// (Azure-Kinect-Sensor-SDK, mode_specific_calibration.c).
#pragma once

#include <string>
#include <string_view>

#include "capture/json_fields.h"
#include "image/view.h"

namespace theatron::capture {

bool looks_like_azure_calibration(std::string_view text);

// For depth pictures of size `depth` and colour pictures of size `color`
// (0 x 0: no colour), which name the modes. Safe for untrusted input.
ParsedCalibration parse_azure_calibration(std::string_view text, Size depth, Size color);

// What an Azure Kinect would carry whose calibration is `calibration`: the text
// that parse_azure_calibration reads as that again, and its modes' names as
// recordings give them. Empty names: no Azure Kinect gives pictures of that size.
struct AzureDescription {
    std::string calibration;
    std::string depth_mode;  // "NFOV_UNBINNED"
    std::string color_mode;  // "MJPG_720P", or "OFF"
};
AzureDescription describe_as_azure(const Calibration& calibration);

}  // namespace theatron::capture
