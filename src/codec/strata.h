// SPDX-License-Identifier: Apache-2.0
// Strata: our own codec for depth images, lossless or with a bounded error.
//
// Each pixel is predicted from its neighbours and from the reference frame. The
// difference is entropy coded; the surroundings of the pixel select the table.
// 32 rows are coded at once, as a diagonal wavefront: strata_layout.h has a
// picture of it. docs/formats/depth_strata.md specifies the bytes.
#pragma once

#include <memory>
#include <vector>

#include "codec/depth_codec.h"
#include "codec/strata_region.h"

namespace theatron::codec {

// The largest difference between decoded and encoded depth, per measured pixel:
// max_error_mm + noise_scaled * (depth / 1024)^2, rounded down, at most 2047.
// Pixels without a measurement stay so, and no others become such. Both 0: lossless.
struct StrataParams {
    int max_error_mm = 0;  // at most 255
    int noise_scaled = 0;  // at most 15
    // The meaning of an empty region. True: the bound holds for the whole image.
    // False: the whole image is exact.
    bool everywhere = false;
};

// The part of an encoded image that is exact.
struct StrataExactness {
    bool whole_image = true;
    strata::Region region;  // used if whole_image is false
};

std::unique_ptr<DepthCodec> make_strata(const StrataParams& params);

// Reads that part from an encoded image. Safe for untrusted input.
Result<StrataExactness> read_strata_exactness(ByteView encoded);

}  // namespace theatron::codec
