// SPDX-License-Identifier: Apache-2.0
// Strata: our own codec for depth images, lossless or with a bounded error.
//
// Each pixel is predicted from its neighbours and from the reference frame; the
// difference is coded with tables that are chosen by what is known around it.
// The work is arranged so that 32 rows are coded together (strata_layout.h). The
// bytes are specified in docs/formats/depth_strata.md.
#pragma once

#include <memory>
#include <vector>

#include "codec/depth_codec.h"
#include "codec/strata_region.h"

namespace theatron::codec {

// How far decoded depth may be from what was encoded, per measured pixel:
// max_error_mm + noise_scaled * (depth / 1024)^2, rounded down, at most 2047.
// Whether a pixel was measured never changes. Both 0: lossless.
struct StrataParams {
    int max_error_mm = 0;  // at most 255
    int noise_scaled = 0;  // at most 15
    // Whether the bound holds for the whole image while no region is drawn;
    // otherwise the whole image is exact then.
    bool everywhere = false;
};

// Where an encoded image is exact.
struct StrataExactness {
    bool whole_image = true;
    strata::Region region;  // if it is not the whole image
};

std::unique_ptr<DepthCodec> make_strata(const StrataParams& params);

// Where an encoded image is exact. Safe for untrusted input.
Result<StrataExactness> read_strata_exactness(ByteView encoded);

}  // namespace theatron::codec
