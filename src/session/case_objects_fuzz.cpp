// SPDX-License-Identifier: Apache-2.0
// Any properties are an object of a case or are refused; an object is written as it was read.
#include <algorithm>
#include <cstdlib>

#include "session/case_objects.h"

using namespace theatron;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView bytes = std::as_bytes(std::span(data, size));
    for (const auto kind : {session::ObjectKind::organ, session::ObjectKind::screen})
        if (const auto object = session::decode_case_object(kind, bytes)) {
            const Bytes again = session::encode_case_object(*object);
            if (!std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()) ||
                !session::may_become(kind, bytes, again))
                std::abort();
        }
    return 0;
}
