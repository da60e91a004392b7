// SPDX-License-Identifier: Apache-2.0
// Run lengths and variable-length differences: Wilson's lossless depth codec.
//
// A. D. Wilson, "Fast Lossless Depth Image Compression", ISS 2017. Runs of pixels
// without and with a measurement alternate; a measured pixel is coded as its
// difference to the measured pixel before. A number is split into groups of three
// bits; each group is stored in a nibble whose fourth bit marks that another group
// follows. docs/formats/depth_rvl.md specifies the bytes.
//
// All functions are pure: no allocation, no state. Safe to call from any thread.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::codec::rvl {

// Bytes that always suffice for an image of this size.
std::size_t max_encoded_size(Size size);

// Encodes `depth`, whose rows must be contiguous, into `out` of max_encoded_size
// bytes and returns the bytes used. Any 16-bit values.
std::size_t encode(DepthView depth, std::span<std::byte> out);

// Reads the size of an encoded image without decoding it.
Result<Size> read_size(ByteView encoded);

// Decodes into `out`, whose rows must be contiguous and whose size must match.
//
// Safe for untrusted input: never reads outside `encoded`, never writes outside
// `out`. On failure the content of `out` is unspecified. Accepts exactly the outputs of
// encode(), so equal images have equal bytes.
Status decode(ByteView encoded, MutableDepthView out);

// The runs without a header, for codecs based on them.
std::size_t max_encoded_runs(std::size_t count);
std::size_t encode_runs(std::span<const std::uint16_t> values, std::span<std::byte> out);
Status decode_runs(ByteView encoded, std::span<std::uint16_t> values);

}  // namespace theatron::codec::rvl
