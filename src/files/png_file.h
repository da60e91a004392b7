// SPDX-License-Identifier: Apache-2.0
// PNG pictures: 16-bit grey for depth, 8-bit RGB for colour.
//
// Functions that take a path throw Error, one sentence that names the file; they are for
// set-up, tools and tests. The decoding functions are safe for untrusted bytes.
#pragma once

#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "image/image.h"

namespace theatron::files {

// Decodes a 16-bit grey picture, value by value, without gamma. Returns an empty string,
// or the problem as the end of a sentence ("is not a PNG picture"). The memory of `out`
// is reused; after a failure its content is unspecified.
std::string decode_png(ByteView png, DepthImage& out);
// Any PNG as RGB: grey and palettes are expanded, 16 bits cut to 8, alpha dropped.
std::string decode_png(ByteView png, ColorImage& out);

DepthImage read_depth_png(const std::filesystem::path& path);
ColorImage read_color_png(const std::filesystem::path& path);

Bytes encode_png(DepthView image);
Bytes encode_png(ColorView image);

void write_png(const std::filesystem::path& path, DepthView image);
void write_png(const std::filesystem::path& path, ColorView image);

}  // namespace theatron::files
