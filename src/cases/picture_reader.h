// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG files as pictures of a case. Only for the process that reads foreign files
// (foreign_files.h), for tests and fuzzing: the libraries below are large, and the files untrusted.
#pragma once

#include "base/bytes.h"
#include "cases/foreign_answer.h"
#include "image/image.h"

namespace theatron::cases {

// Pixels of one file before it is reduced. Larger pictures are refused before memory is taken.
inline constexpr std::size_t max_picture_pixels = std::size_t(100) << 20;

// Answer::content, and the picture upright, in sRGB, at most medical::max_picture_side pixels a
// side, transparent places on white; or why it cannot be shown. Takes at most 8 bytes a pixel.
Answer read_picture(ByteView file, ColorImage& out);

}  // namespace theatron::cases
