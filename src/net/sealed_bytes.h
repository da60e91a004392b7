// SPDX-License-Identifier: Apache-2.0
// Bytes that only who knows a passphrase can read: scrypt (RFC 7914) makes the key, AES-256-GCM
// seals them. The form is specified in docs/formats/enrolled_face.md.
#pragma once

#include <array>
#include <optional>

#include "base/bytes.h"
#include "base/status.h"

namespace theatron::net {

inline constexpr std::string_view sealed_magic = "TFSEAL";

// The binary logarithm of scrypt's N, with r 8 and p 1: memory is 1 KiB times N. At the usual cost
// a guess takes 128 MiB and some tenths of a second.
inline constexpr int least_seal_cost = 14, usual_seal_cost = 17, most_seal_cost = 18;

struct Sealed {
    int cost = usual_seal_cost;
    std::array<std::byte, 16> salt{};
    std::array<std::byte, 12> nonce{};
    std::array<std::byte, 16> tag{};
    Bytes content;  // encrypted
};

// Throws Error if OpenSSL cannot do it here.
Sealed seal(ByteView content, std::string_view passphrase, int cost = usual_seal_cost);
// nullopt: another passphrase, or something was changed; nothing tells which. Throws Error if
// there is no memory for it, or OpenSSL cannot do it here.
std::optional<Bytes> unseal(const Sealed& sealed, std::string_view passphrase);

Bytes sealed_bytes(const Sealed& sealed);
// Safe on any bytes.
Result<Sealed> parse_sealed(ByteView bytes);

}  // namespace theatron::net
