// SPDX-License-Identifier: Apache-2.0
#include "wire/relay_greeting.h"

#include <algorithm>
#include <array>

#include "wire/control.h"

namespace theatron::wire {
namespace {

// "TREL" and the version.
constexpr std::array relay_mark{std::byte{'T'}, std::byte{'R'}, std::byte{'E'}, std::byte{'L'},
                                relay_version};

}  // namespace

Bytes encode_relay_greeting(ByteView secret) {
    Bytes bytes(relay_mark.begin(), relay_mark.end());
    bytes.insert(bytes.end(), secret.begin(), secret.end());
    return bytes;
}

std::optional<ByteView> read_relay_greeting(ByteView bytes) {
    if (bytes.size() != relay_mark.size() + relay_secret_size ||
        !std::equal(relay_mark.begin(), relay_mark.end(), bytes.begin()))
        return std::nullopt;
    return bytes.subspan(relay_mark.size());
}

}  // namespace theatron::wire
