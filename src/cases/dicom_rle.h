// SPDX-License-Identifier: Apache-2.0
// Pixels packed as RLE (DICOM PS3.5, annex G): a header, then a segment for each byte of a value,
// the highest first, each packed as PackBits.
//
// Pure. GDCM's own decoder reads beyond the end of damaged segments.
#pragma once

#include <vector>

#include "base/bytes.h"

namespace theatron::cases {

// Fills `values` from one frame of values of `bytes` (1 or 2) each. False for bytes that are no
// such frame, or too few; then `values` may be anything. Safe for untrusted input.
bool unpack_rle(ByteView frame, int bytes, std::vector<int>& values);

}  // namespace theatron::cases
