// SPDX-License-Identifier: Apache-2.0
// Any sequence of envelopes (each behind a two-byte length): unwrapping and
// header parsing stay inside their input, and where only control is taken no media comes out.
#include <cstdlib>

#include "wire/envelope.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    ByteReader in(std::as_bytes(std::span(data, size)));
    wire::Unwrapper unwrapper, host(wire::Unwrapper::Takes::control);
    while (!in.rest().empty()) {
        const std::size_t length = in.get<std::uint16_t>();
        // An exact copy, so that a read past the end is seen.
        const ByteView part = in.get_bytes(std::min(length, in.rest().size()));
        const Bytes envelope(part.begin(), part.end());
        if (const auto control = host.take(envelope))
            if (!control->media.empty() || control->control.empty())
                std::abort();
        if (host.media_bytes() > 0)
            std::abort();
        const auto got = unwrapper.take(envelope);
        if (!got)
            return 0;
        if (!got->media.empty())
            (void)wire::parse_media_header(got->media);
    }
    return 0;
}
