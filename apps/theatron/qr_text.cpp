// SPDX-License-Identifier: Apache-2.0
#include "qr_text.h"

#include "host/qr_code.h"

namespace theatron::app {

std::string qr_text(const std::string& text, bool colored) {
    constexpr int quiet = host::qr_quiet_zone;
    const std::vector<std::string> rows = host::qr_rows(text);
    const int width = int(rows.size());
    const auto is_light = [&](int x, int y) {
        const bool inside = x >= 0 && y >= 0 && x < width && y < width;
        return !inside || rows[std::size_t(y)][std::size_t(x)] == '0';
    };
    std::string lines;
    for (int y = -quiet; y < width + quiet; y += 2) {
        if (colored)
            lines += "\033[40;97m";
        for (int x = -quiet; x < width + quiet; ++x) {
            const bool upper = is_light(x, y);
            const bool lower = y + 1 < width + quiet && is_light(x, y + 1);
            lines += upper && lower ? "\u2588" : upper ? "\u2580" : lower ? "\u2584" : " ";
        }
        lines += colored ? "\033[0m\n" : "\n";
    }
    return lines;
}

}  // namespace theatron::app
