// SPDX-License-Identifier: Apache-2.0
// Any bytes give a problem or a calibration that is valid in network messages.
#include <cstdlib>

#include "capture/azure_calibration.h"
#include "capture/folder_calibration.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    using namespace theatron::capture;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    constexpr Size depth{640, 576}, color{1280, 720};
    for (const auto parse :
         {parse_folder_calibration, parse_azure_calibration, parse_intrinsics_matrix})
        for (const Size color_size : {color, Size{}}) {
            const ParsedCalibration parsed = parse(text, depth, color_size);
            if (!parsed.problem.empty())
                continue;
            const auto again = decode_calibration(encode_calibration(parsed.calibration));
            if (!again || parsed.calibration.depth.size != depth)
                std::abort();
        }
    return 0;
}
