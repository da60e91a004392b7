// SPDX-License-Identifier: Apache-2.0
// Any bytes are a description of a case or are refused; a description is written as it was read.
#include <cstdlib>

#include "medical/shared_case.h"

using namespace theatron;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto shared = medical::decode_shared_case(std::as_bytes(std::span(data, size)));
    if (!shared)
        return 0;
    const auto again = medical::decode_shared_case(medical::encode_shared_case(*shared));
    if (!again || again->parts.size() != shared->parts.size() ||
        again->content_bytes() != shared->content_bytes())
        std::abort();
    return 0;
}
