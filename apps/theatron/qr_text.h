// SPDX-License-Identifier: Apache-2.0
// A text as a QR code for a terminal.
#pragma once

#include <string>

namespace theatron::app {

// Lines of block characters, two rows of the code each, light where the code is light, with the
// quiet zone around it that readers need. `colored`: with escape sequences, so that the code is
// right on light and dark terminals. Throws Error if the text has more bytes than a code holds.
std::string qr_text(const std::string& text, bool colored);

}  // namespace theatron::app
