// SPDX-License-Identifier: Apache-2.0
// Any bytes: decoding stays inside them. Bytes that are accepted: encoding gives the same again,
// within the bound of an object's properties.
#include <cmath>
#include <cstdlib>

#include "session/mark.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const ByteView bytes = std::as_bytes(std::span(data, size));
    const std::optional<session::Mark> mark = session::decode_mark(bytes);
    if (!mark)
        return 0;
    const Bytes again = session::encode_mark(*mark);
    if (again.size() > 4096 || !std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()))
        std::abort();
    return 0;
}
