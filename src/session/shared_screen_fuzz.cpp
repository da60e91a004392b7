// SPDX-License-Identifier: Apache-2.0
// Any properties are a shared screen or are refused; what was read is read again as the same.
#include <cstdlib>

#include "session/shared_screen.h"

using namespace theatron;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView bytes = std::as_bytes(std::span(data, size));
    if (const auto screen = session::decode_shared_screen(session::ObjectKind::screen, bytes)) {
        const Bytes again = session::encode_shared_screen(*screen);
        if (session::decode_shared_screen(session::ObjectKind::screen, again) != screen)
            std::abort();
    }
    return 0;
}
