// SPDX-License-Identifier: Apache-2.0
// Any bytes as something sealed with a passphrase: what is taken is the same bytes again.
#include <algorithm>
#include <cstdlib>

#include "net/sealed_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    const Bytes exact(input.begin(), input.end());
    const auto sealed = net::parse_sealed(exact);
    if (!sealed)
        return 0;
    const Bytes again = net::sealed_bytes(*sealed);
    if (!std::equal(again.begin(), again.end(), exact.begin(), exact.end()))
        std::abort();
    return 0;
}
