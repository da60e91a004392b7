// SPDX-License-Identifier: Apache-2.0
// The eight bytes in front of every encoded depth image.
//
//   codec u8, version u8, flags u8, parameter u8, width u16, height u16
//
// They make an image self-describing: codec, parameters and size.
// docs/formats/depth_payload.md specifies them.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "codec/depth_codec.h"

namespace theatron::codec {

struct PayloadHeader {
    DepthCodecId codec = DepthCodecId::raw;
    bool delta = false;          // coded against a reference frame
    std::uint8_t parameter = 0;  // meaning and range depend on the codec
    Size size;
};

inline constexpr std::size_t payload_header_size = 8;

// Writes the header to the first payload_header_size bytes of `out`.
void put_header(const PayloadHeader& header, std::byte* out);

// Reads the header of an image of `codec`. Safe for untrusted input; the size returned
// is valid. Malformed: a delta frame if `may_be_delta` is false, or a parameter above
// `max_parameter`.
Result<PayloadHeader> read_header(ByteView encoded, DepthCodecId codec, bool may_be_delta,
                                  int max_parameter = 0);

}  // namespace theatron::codec
