// SPDX-License-Identifier: Apache-2.0
#include "qr_text.h"

#include <qrencode.h>

#include <memory>

#include "base/error.h"

namespace theatron::app {

std::string qr_text(const std::string& text, bool colored) {
    constexpr int quiet = 4;  // modules on each side, as ISO/IEC 18004 requires
    constexpr int version = 0, case_sensitive = 1;  // the smallest that fits
    const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
        QRcode_encodeString(text.c_str(), version, QR_ECLEVEL_L, QR_MODE_8, case_sensitive),
        &QRcode_free);
    if (!code)
        throw Error("The text is too long for a QR code.");
    const int width = code->width;
    const auto is_light = [&](int x, int y) {
        const bool inside = x >= 0 && y >= 0 && x < width && y < width;
        return !inside || (code->data[y * width + x] & 1) == 0;
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
