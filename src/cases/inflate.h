// SPDX-License-Identifier: Apache-2.0
// Unpacks what other programs packed with zlib or bzip2, up to a bound. Safe for any bytes.
#pragma once

#include <cstdint>
#include <functional>

#include "base/bytes.h"

namespace theatron::cases {

enum class Packing : std::uint8_t { gzip, deflate, zlib, bzip2 };

// Unpacks and calls `take` for each piece, until `take` returns false or all `wanted` bytes have
// been passed; never unpacks more. Packed parts that follow one another are one content (bgzip,
// pigz). Returns how many bytes were passed; `damaged` says whether the packed bytes are.
std::size_t unpack(ByteView packed, Packing packing, std::size_t wanted,
                   const std::function<bool(ByteView)>& take, bool& damaged);

struct Unpacked {
    bool whole = false;      // to its end
    bool too_large = false;  // it has more than `most` bytes
    Bytes bytes;
};
Unpacked unpack(ByteView packed, Packing packing, std::size_t most);

// No stream unpacks to more than this many times its size: 45 899 236 equal bytes become 45 in
// bzip2.
inline constexpr std::size_t gzip_most_ratio = 1040, bzip2_most_ratio = 1'100'000;
inline std::size_t most_ratio(Packing packing) {
    return packing == Packing::bzip2 ? bzip2_most_ratio : gzip_most_ratio;
}

}  // namespace theatron::cases
