// SPDX-License-Identifier: Apache-2.0
// SHA-256 (FIPS 180-4) in plain code, for a browser's page, where no library is at hand.
#pragma once

#include <array>
#include <cstdint>

#include "base/content_hash.h"

namespace theatron::net {

class Sha256 final : public ContentDigest {
public:
    void add(ByteView piece) override;
    ContentHash finish() override;  // once

private:
    void take_block(const std::byte* block);

    std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<std::byte, 64> block_{};
    std::size_t filled_ = 0;  // bytes in block_
    std::uint64_t size_ = 0;  // of all bytes
};

}  // namespace theatron::net
