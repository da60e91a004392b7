// SPDX-License-Identifier: Apache-2.0
// Any bytes: reading stays inside them. An accepted greeting is made again from its secret.
#include <cstdlib>

#include "wire/relay_greeting.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const auto secret = wire::read_relay_greeting(bytes);
    if (secret && wire::encode_relay_greeting(*secret) != Bytes(bytes.begin(), bytes.end()))
        std::abort();
    return 0;
}
