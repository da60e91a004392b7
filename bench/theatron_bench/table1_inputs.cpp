// SPDX-License-Identifier: Apache-2.0
#include "table1_inputs.h"

#include <algorithm>
#include <cmath>

#include "base/options.h"
#include "table1.h"

namespace theatron::bench {

std::string played_for_long(const std::string& camera) {
    const std::string kind = Options::parse(camera).kind();
    const bool recorded = kind == "folder" || kind == "mkv" || kind == "recording";
    std::string result = camera;
    const auto add = [&](const std::string& option) {
        const bool first = result.find(':') == std::string::npos;
        if (result.find(option + "=") == std::string::npos)
            result += (first ? ":" : ",") + option + "=1";
    };
    if (recorded)
        add("loop");
    if (recorded || kind == "synthetic")
        add("preload");
    return result;
}

capture::Crop paper_crop(Size full) {
    const auto part = [](int pixels, int cropped, int whole) {
        return std::max(2, int(std::lround(double(pixels) * cropped / whole)) / 2 * 2);
    };
    const Size size{part(full.width, paper_cropped.width, paper_full.width),
                    part(full.height, paper_cropped.height, paper_full.height)};
    return {(full.width - size.width) / 2, (full.height - size.height) / 2, size};
}

std::string size_text(Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace theatron::bench
