// SPDX-License-Identifier: Apache-2.0
// What the stand-in's cameras see, and the calibration they carry.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace standin {

using Bytes = std::vector<std::uint8_t>;

// A sloping wall with a box in front that moves with `frame`; pixel (0, 0) holds
// `frame` itself. Rows are `stride` bytes long; what lies between them is 0xee.
Bytes depth_picture(int width, int height, int stride, int frame);

// A JPEG of a gradient, the number of the frame in a comment right behind its start.
Bytes color_picture(int width, int height, int frame);

// A made-up factory calibration as the devices store it.
std::string calibration();

}  // namespace standin
