// SPDX-License-Identifier: Apache-2.0
// Any bytes as a person's own face: what is taken for one is the same bytes again, and can be
// blended.
#include <algorithm>
#include <cstdlib>

#include "face/enrolled_face.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    const Bytes exact(input.begin(), input.end());
    const auto read = face::parse_enrolled(exact);
    if (!read)
        return 0;
    const Bytes again = face::enrolled_bytes(*read);
    if (!std::equal(again.begin(), again.end(), exact.begin(), exact.end()))
        std::abort();
    std::vector<float> blended(read->rest.points.size());
    face::blend_face(*read, {0.5F, 1, 0, 0, 0, 0}, {1, 1, 0}, blended);
    return 0;
}
