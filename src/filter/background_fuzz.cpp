// SPDX-License-Identifier: Apache-2.0
// Any bytes: reading stays inside its buffers. Accepted bytes are encoded to equal bytes.
#include <algorithm>
#include <cstdlib>

#include "filter/background.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView input = std::as_bytes(std::span(data, size));
    const auto background = filter::decode_background(input);
    if (!background)
        return 0;
    const Bytes again = filter::encode_background(*background);
    if (!std::equal(again.begin(), again.end(), input.begin(), input.end()))
        std::abort();
    return 0;
}
