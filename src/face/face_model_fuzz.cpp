// SPDX-License-Identifier: Apache-2.0
// Any bytes as a model and as landmarks: what is taken for a model is the same model again.
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
    // Files of the first version are written as those of the newest.
    const Bytes again = face::model_bytes(*model);
    const auto second = face::parse_model(again);
    if (!second || face::model_bytes(*second) != again)
        std::abort();
    return 0;
}
