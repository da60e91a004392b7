// SPDX-License-Identifier: Apache-2.0
// The factory calibration of an Azure Kinect, stored in the device and in its recordings (a
// JSON text with "CalibrationInformation"), converted for the modes of the camera.
//
// The text describes the whole sensors in normalised units, with (0, 0) in the corner of the
// first pixel. Each mode bins or scales the sensor and crops it. The modes' numbers are facts
// of the device, as in the camera's SDK (Azure-Kinect-Sensor-SDK,
// mode_specific_calibration.c).
#pragma once

#include <string>
#include <string_view>

#include "capture/json_fields.h"
#include "image/view.h"

namespace theatron::capture {

bool looks_like_azure_calibration(std::string_view text);

// `depth` and `color` are the sizes of the pictures, which determine the modes (colour 0 x 0:
// none). Safe for untrusted input.
ParsedCalibration parse_azure_calibration(std::string_view text, Size depth, Size color);

// The inverse: the factory calibration that parse_azure_calibration would read as
// `calibration`, and the names of the modes as in recordings. The names are empty if no Azure
// Kinect has pictures of that size.
struct AzureDescription {
    std::string calibration;
    std::string depth_mode;  // "NFOV_UNBINNED"
    std::string color_mode;  // "MJPG_720P", or "OFF"
};
AzureDescription describe_as_azure(const Calibration& calibration);

}  // namespace theatron::capture
