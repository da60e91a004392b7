// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. Accepted bytes are encoded to equal bytes.
#include <cstdlib>

#include "geometry/calibration.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = std::as_bytes(std::span(data, size));
    const auto calibration = theatron::decode_calibration(input);
    if (!calibration)
        return 0;
    const theatron::Bytes again = theatron::encode_calibration(*calibration);
    // Exceptions: version 0 is read as 1, and NaNs have several encodings.
    if (again.size() != size)
        std::abort();
    return 0;
}
