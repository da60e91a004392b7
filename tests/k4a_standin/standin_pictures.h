// SPDX-License-Identifier: Apache-2.0
// The pictures of the stand-in's cameras, and their calibration.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace standin {

using Bytes = std::vector<std::uint8_t>;

// A sloping wall with a box in front that moves with `frame`; pixel (0, 0) is `frame`. Rows are
// `stride` bytes apart; padding bytes are 0xee.
Bytes depth_picture(int width, int height, int stride, int frame);

// A JPEG of a gradient, with the frame number in a comment directly after the start marker.
Bytes color_picture(int width, int height, int frame);

// An invented factory calibration in the devices' format.
std::string calibration();

}  // namespace standin
