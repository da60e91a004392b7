// SPDX-License-Identifier: Apache-2.0
// Texts of DICOM files in UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace theatron::cases {

// `charset`: the file's SpecificCharacterSet (PS3.3, C.12.1.1.2); of several the first one counts,
// and the escape sequences of Japanese, Korean and Chinese texts say themselves what they are.
// Bytes that are not of it, and texts without one, are taken as UTF-8 if they are, else as Latin-1,
// which scanners write without saying so. Safe for untrusted input; valid UTF-8 in any case.
std::string utf8_of_dicom(std::string_view text, std::string_view charset);

}  // namespace theatron::cases
