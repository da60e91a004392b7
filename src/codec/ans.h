// SPDX-License-Identifier: Apache-2.0
// The runs and differences of RVL, entropy coded with rANS instead of nibbles.
//
// The same numbers as in rvl.h, or in trvl.h where there is a reference, in two
// sequences: the lengths of runs, and the differences. Each goes through
// ans_coder.h. An eighth to three fifths smaller than rvl, for two to three times its
// time. The bytes are specified in docs/formats/depth_ans.md.
//
// All functions are pure but for the memory in `work`, which they use again.
// Safe to call from any thread with a Workspace of its own.
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
    // Room for the most there can be, and how many there are.
    std::vector<std::uint32_t> runs;
    std::vector<std::uint32_t> differences;
    std::size_t run_count = 0;
    std::size_t difference_count = 0;
};

// Bytes that always suffice for an image of this size.
std::size_t max_encoded_size(Size size);

// Encodes `depth` into `out` of max_encoded_size bytes and returns the bytes
// used. `reference` has the same size; without pixels it makes a key frame.
std::size_t encode(DepthView depth, DepthView reference, DepthWorkspace& work,
                   std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose size must match the encoded image. `reference` is
// only looked at by frames that need it; without pixels, or of another size, it
// counts as missing.
//
// Safe for untrusted input: never reads outside `encoded`, never writes outside
// `out`; `work` grows to a few numbers for each pixel of `out`. On failure the
// content of `out` is unspecified.
Status decode(ByteView encoded, DepthView reference, DepthWorkspace& work, MutableDepthView out);

}  // namespace theatron::codec::ans
