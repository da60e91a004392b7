// SPDX-License-Identifier: Apache-2.0
#include "host/qr_code.h"

#include <qrencode.h>

#include <memory>

#include "base/error.h"

namespace theatron::host {

std::vector<std::string> qr_rows(const std::string& text) {
    constexpr int version = 0, case_sensitive = 1;  // the smallest that fits
    const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
        QRcode_encodeString(text.c_str(), version, QR_ECLEVEL_L, QR_MODE_8, case_sensitive),
        &QRcode_free);
    if (!code)
        throw Error("The text is too long for a QR code.");
    std::vector<std::string> rows(std::size_t(code->width));
    for (int y = 0; y < code->width; ++y)
        for (int x = 0; x < code->width; ++x)
            rows[std::size_t(y)] += (code->data[y * code->width + x] & 1) != 0 ? '1' : '0';
    return rows;
}

}  // namespace theatron::host
