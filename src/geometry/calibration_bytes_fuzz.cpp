// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. An accepted calibration encodes to bytes that decode to
// the same.
#include <cstdlib>

#include "geometry/calibration.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = std::as_bytes(std::span(data, size));
    const auto calibration = theatron::decode_calibration(input);
    if (!calibration)
        return 0;
    const auto again = theatron::decode_calibration(theatron::encode_calibration(*calibration));
    if (!again || *again != *calibration)
        std::abort();
    return 0;
}
