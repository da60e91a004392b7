// SPDX-License-Identifier: Apache-2.0
// What a JPEG picture says about itself before any pixel: enough to refuse it,
// to check its size and to reserve memory, without a JPEG library.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video {

// The size of the sequential Huffman-coded JPEG picture (grey or three
// components, eight bits, one scan) in `jpeg`. Safe for untrusted input. Refuses
//  - progressive, lossless and arithmetic-coded pictures and those of several
//    scans (unsupported): cameras give none, and decoding them needs time and
//    memory that a small hostile file can multiply at will;
//  - sizes beyond max_side (too_large);
//  - pictures with fewer bytes than their smallest coding (truncated).
Result<Size> read_jpeg_size(ByteView jpeg);

}  // namespace theatron::video
