// SPDX-License-Identifier: Apache-2.0
// The only message that a receiver sends to a relay, as control (docs/formats/connection.md).
#pragma once

#include <optional>

#include "base/bytes.h"

namespace theatron::wire {

inline constexpr std::byte relay_version{1};

// `secret`: wire::relay_secret_size bytes.
Bytes encode_relay_greeting(ByteView secret);
// The secret. Safe for untrusted input: everything but a greeting of this version is refused.
std::optional<ByteView> read_relay_greeting(ByteView bytes);

}  // namespace theatron::wire
