// SPDX-License-Identifier: Apache-2.0
// Floats in byte sequences, as the bits of IEEE 754 binary32, little-endian.
#pragma once

#include <cstring>

#include "base/bytes.h"

namespace theatron {

// Without std::bit_cast, which em++'s library does not have.
inline void store_f32(std::byte* out, float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    store_le(out, bits);
}

inline float load_f32(const std::byte* in) {
    const auto bits = load_le<std::uint32_t>(in);
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
}

inline void put_f32(ByteWriter& out, float value) {
    std::byte bytes[sizeof(value)];
    store_f32(bytes, value);
    out.put_bytes(bytes);
}

// 0 past the end, where the reader fails.
inline float get_f32(ByteReader& in) {
    const ByteView bytes = in.get_bytes(sizeof(float));
    return bytes.empty() ? 0 : load_f32(bytes.data());
}

}  // namespace theatron
