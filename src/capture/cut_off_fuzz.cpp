// SPDX-License-Identifier: Apache-2.0
// is_cut_off() must be safe for any bytes, and a file of the largest size is never cut off.
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "capture/cut_off.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView beginning(reinterpret_cast<const std::byte*>(data), size);
    (void)capture::is_cut_off(beginning, size);
    if (capture::is_cut_off(beginning, std::numeric_limits<std::uint64_t>::max()))
        std::abort();
    return 0;
}
