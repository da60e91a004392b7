// SPDX-License-Identifier: Apache-2.0
// A text as a QR code (ISO/IEC 18004).
#pragma once

#include <string>
#include <vector>

namespace theatron::host {

// Modules on each side of a code that readers need to be light.
inline constexpr int qr_quiet_zone = 4;

// One text a row, without the quiet zone: '1' for a dark module, '0' for a light one. Throws Error
// if the text has more bytes than a code holds.
std::vector<std::string> qr_rows(const std::string& text);

}  // namespace theatron::host
