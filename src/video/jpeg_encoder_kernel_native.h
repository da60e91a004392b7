// SPDX-License-Identifier: Apache-2.0
// The inner part of our JPEG encoder: from pixels to the bytes of a scan, with
// the best instructions of this CPU. jpeg_encoder_reference.h defines it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/view.h"
#include "video/jpeg_encoder_rule.h"

namespace theatron::video::jpeg {

// The divisors of luma's and chroma's coefficients, column by column as they lie
// in a block.
struct ScanTables {
    alignas(64) std::int16_t factor[2][64];
    alignas(64) std::int16_t scale[2][64];

    explicit ScanTables(int quality);
};

// An upper bound of what a scan takes, and of its part of one row of units
// before stuffing. A coefficient takes at most 26 bits, and stuffing at most
// doubles them. Hardly any of it is ever touched.
std::size_t max_scan_size(Size size, bool halve_chroma);
std::size_t max_row_size(int width, bool halve_chroma);

// Writes the scan of `image` to `out`, which holds max_scan_size, and returns
// its end. `row_buffer` holds max_row_size.
std::uint8_t* encode_scan(ColorView image, bool halve_chroma, const ScanTables& tables,
                          std::uint8_t* row_buffer, std::uint8_t* out);

}  // namespace theatron::video::jpeg
