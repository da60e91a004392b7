// SPDX-License-Identifier: Apache-2.0
#include "wire/direct_greeting.h"

#include <algorithm>
#include <array>

#include "wire/control.h"

namespace theatron::wire {
namespace {

// "TDIR" and the version.
constexpr std::array direct_mark{std::byte{'T'}, std::byte{'D'}, std::byte{'I'}, std::byte{'R'},
                                 direct_version};

}  // namespace

Bytes encode_direct_greeting(ByteView secret) {
    Bytes bytes(direct_mark.begin(), direct_mark.end());
    bytes.insert(bytes.end(), secret.begin(), secret.end());
    return bytes;
}

std::optional<ByteView> read_direct_greeting(ByteView bytes) {
    if (bytes.size() != direct_mark.size() + direct_secret_size ||
        !std::equal(direct_mark.begin(), direct_mark.end(), bytes.begin()))
        return std::nullopt;
    return bytes.subspan(direct_mark.size());
}

}  // namespace theatron::wire
