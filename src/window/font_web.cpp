// SPDX-License-Identifier: Apache-2.0
// A browser's page draws its letters with the browser's own fonts.
#include "window/font.h"

namespace theatron::window {

std::span<const std::byte> text_font() {
    return {};
}

}  // namespace theatron::window
