// SPDX-License-Identifier: Apache-2.0
#include "window/font.h"

// The assembler reads the file: 750 kB as numbers in a source would take seconds to compile.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    "theatron_font_begin:\n"
    ".incbin \"" THEATRON_FONT
    "\"\n"
    "theatron_font_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
__attribute__((visibility("hidden"))) extern const std::byte theatron_font_begin[];
__attribute__((visibility("hidden"))) extern const std::byte theatron_font_end[];
}

namespace theatron::window {

std::span<const std::byte> text_font() {
    return {theatron_font_begin, theatron_font_end};
}

}  // namespace theatron::window
