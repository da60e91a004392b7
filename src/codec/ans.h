// SPDX-License-Identifier: Apache-2.0
// Runs and differences as in RVL, entropy coded with rANS instead of nibbles.
//
// The pixels (rvl.h), or their change since a reference frame (trvl.h), become two
// sequences: run lengths and differences. Each is coded by ans_coder.h. The result is
// an eighth to three fifths smaller than rvl, for two to three times its time.
// docs/formats/depth_ans.md specifies the bytes.
//
// All functions are pure except for the memory in `work`, which they reuse. Safe to
// call from any thread with a workspace of its own.
#pragma once

#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "codec/ans_coder.h"
#include "image/view.h"

namespace theatron::codec::ans {

struct DepthWorkspace {
    Workspace coder;
    std::vector<std::uint16_t> values;
    // Sized for the largest possible counts; the actual counts are stored below.
    std::vector<std::uint32_t> runs;
    std::vector<std::uint32_t> differences;
    std::size_t run_count = 0;
    std::size_t difference_count = 0;
};

// Bytes that always suffice for an image of this size.
std::size_t max_encoded_size(Size size);

// Encodes `depth` into `out` of max_encoded_size bytes and returns the bytes
// used. `reference` has the same size; if it has no pixels, a key frame results.
std::size_t encode(DepthView depth, DepthView reference, DepthWorkspace& work,
                   std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match the encoded image. `reference` is read
// by delta frames only; one without pixels or of another size counts as missing.
//
// Safe for untrusted input: never reads outside `encoded`, never writes outside
// `out`; `work` grows in proportion to the pixels of `out`. On failure the content
// of `out` is unspecified.
Status decode(ByteView encoded, DepthView reference, DepthWorkspace& work, MutableDepthView out);

}  // namespace theatron::codec::ans
