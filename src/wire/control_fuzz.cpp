// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. What is accepted encodes again to
// something that decodes.
#include <cstdlib>

#include "wire/control.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto message = theatron::wire::decode_control(std::as_bytes(std::span(data, size)));
    if (message && !theatron::wire::decode_control(theatron::wire::encode_control(*message)))
        std::abort();
    return 0;
}
