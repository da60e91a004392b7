// SPDX-License-Identifier: Apache-2.0
// Any bytes as a reader's answer or description: accepted ones are within their limits and are
// encoded to equal bytes.
#include <cstdlib>

#include "capture/mkv_answer.h"

using namespace theatron;
using namespace theatron::capture;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView bytes = std::as_bytes(std::span(data, size));
    constexpr std::size_t shared_bytes = 1 << 20;
    if (const auto answer = decode_mkv_answer(bytes, shared_bytes)) {
        const Bytes again = encode(*answer);
        if (answer->bytes > shared_bytes || again != Bytes(bytes.begin(), bytes.end()))
            std::abort();
    }
    if (const auto description = decode_mkv_description(bytes)) {
        const Bytes again = encode(*description);
        if (!is_valid(description->depth) ||
            description->calibration.size() > max_calibration_bytes ||
            again != Bytes(bytes.begin(), bytes.end()))
            std::abort();
    }
    return 0;
}
