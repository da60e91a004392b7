// SPDX-License-Identifier: Apache-2.0
// CRC-32C (Castagnoli), the checksum of pictures and heads in recordings.
#pragma once

#include <cstdint>

#include "base/bytes.h"

namespace theatron::record {

// The checksum of `bytes`; `before`: that of the bytes in front of them, so that parts may be
// given one by one. Pure. Uses the CPU's own instruction where there is one.
std::uint32_t crc32c(ByteView bytes, std::uint32_t before = 0);

// The same in the plainest form: the definition.
std::uint32_t crc32c_reference(ByteView bytes, std::uint32_t before = 0);

}  // namespace theatron::record
