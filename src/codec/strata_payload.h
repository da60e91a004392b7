// SPDX-License-Identifier: Apache-2.0
// The header, parameters and coder states of an encoded Strata image.
// docs/formats/depth_strata.md specifies them.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "codec/strata_kernel.h"
#include "codec/strata_region.h"

namespace theatron::codec::strata {

struct Payload {
    Size size;
    bool delta = false;  // refers to a reference frame
    bool blend = false;
    bool ranks = false;  // depth is coded as ranks in a value table
    Tolerance tolerance;
    Region region;  // empty unless there is a tolerance
    Weights weights{};
    std::array<std::uint32_t, lane_count> states{};
    ByteView side;
    ByteView words;
};

inline bool is_codable(Size size) {
    return theatron::is_valid(size);
}

// Bytes that always suffice for an image of this size.
std::size_t max_payload_size(Size size);

// Writes an image into `out` (max_payload_size bytes) and returns the bytes used.
std::size_t put_payload(const Payload& payload, ByteView side, const Stream& stream,
                        std::span<std::byte> out);

// Parses everything but the contents of `side` and `words`, which become views
// into `encoded`. Safe for untrusted input.
Result<Payload> read_payload(ByteView encoded);

}  // namespace theatron::codec::strata
