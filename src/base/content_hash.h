// SPDX-License-Identifier: Apache-2.0
// The name of content that travels by its hash: SHA-256 (FIPS 180-4) of its bytes.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "base/bytes.h"

namespace theatron {

struct ContentHash {
    static constexpr std::size_t size = 32;
    std::array<std::byte, size> bytes{};

    // em++'s library has no operator<=> of arrays.
    bool operator==(const ContentHash&) const = default;
    bool operator<(const ContentHash& other) const { return bytes < other.bytes; }
};

// nullopt for any other number of bytes.
inline std::optional<ContentHash> to_content_hash(ByteView bytes) {
    if (bytes.size() != ContentHash::size)
        return std::nullopt;
    ContentHash hash;
    std::copy(bytes.begin(), bytes.end(), hash.bytes.begin());
    return hash;
}

// Computes a hash of content that comes in pieces. Modules without cryptography are given one.
class ContentDigest {
public:
    virtual ~ContentDigest() = default;
    virtual void add(ByteView piece) = 0;
    // Ends the computation.
    virtual ContentHash finish() = 0;
};

}  // namespace theatron
