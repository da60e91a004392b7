// SPDX-License-Identifier: Apache-2.0
// Any packets of voice at any times: the parser, the jitter buffer and the decoder stay inside
// their input and fill every block with finite samples.
#include <cmath>
#include <cstdlib>

#include "voice/opus_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    ByteReader in(std::as_bytes(std::span(data, size)));
    voice::Decoder decoder;
    voice::Playout playout(decoder);
    std::vector<float> block(480);
    TimePoint now;
    while (!in.rest().empty()) {
        now += Duration(in.get<std::uint16_t>());
        const unsigned blocks = in.get<std::uint8_t>() % 4;
        const std::size_t length = in.get<std::uint8_t>();
        // An exact copy, so that a read past the end is seen.
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        const Bytes bytes(part.begin(), part.end());
        if (const auto packet = voice::parse_packet(bytes)) {
            Bytes again;
            voice::write_packet(*packet, again);
            if (again != bytes)
                std::abort();
            playout.put(*packet, now);
        }
        for (unsigned i = 0; i < blocks; ++i) {
            playout.pull(block, now);
            for (const float sample : block)
                if (!std::isfinite(sample))
                    std::abort();
        }
    }
    return 0;
}
