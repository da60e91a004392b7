// SPDX-License-Identifier: Apache-2.0
// decode_video_answer() must be safe for any bytes, and what it accepts must fit.
#include <cstdint>
#include <cstdlib>

#include "capture/video_answer.h"
#include "sandbox/limits.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const auto answer = capture::decode_video_answer(
        {reinterpret_cast<const std::byte*>(data), size}, sandbox::max_area_bytes);
    if (answer && answer->kind == capture::VideoAnswer::Kind::opened &&
        3 * answer->size.area() > sandbox::max_area_bytes)
        std::abort();
    return 0;
}
