// SPDX-License-Identifier: Apache-2.0
// Any bytes as a model and as landmarks: what is taken for a model is the same bytes again.
#include <algorithm>
#include <cstdlib>

#include "face/face_fit.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto input = std::as_bytes(std::span(data, size));
    (void)face::parse_pts(std::string_view(reinterpret_cast<const char*>(data), size));
    const Bytes exact(input.begin(), input.end());
    const auto model = face::parse_model(exact);
    if (!model)
        return 0;
    const Bytes again = face::model_bytes(*model);
    if (!std::equal(again.begin(), again.end(), exact.begin(), exact.end()))
        std::abort();
    return 0;
}
