// SPDX-License-Identifier: Apache-2.0
// Any packets: the parser stays inside its input, and channels stay within 0..1.
#include <cstdlib>

#include "face/osc_face.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    ByteReader in(std::as_bytes(std::span(data, size)));
    face::OscFace face;
    while (!in.rest().empty()) {
        const std::size_t length = in.get<std::uint16_t>() % 2048;
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        // An exact copy, so that a read past the end is seen.
        const Bytes packet(part.begin(), part.end());
        face.take(packet, TimePoint());
    }
    const face::Mapped mapped = face.mapped();
    for (std::size_t i = 0; i < face::channel_count; ++i)
        if (!(mapped.values[i] >= 0 && mapped.values[i] <= 1) ||
            (!mapped.present[i] && mapped.values[i] != 0))
            std::abort();
    return 0;
}
