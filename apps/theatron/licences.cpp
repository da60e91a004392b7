// SPDX-License-Identifier: Apache-2.0
#include "licences.h"

__asm__(
    ".pushsection .rodata\n"
    "theatron_licences_begin:\n"
    ".incbin \"" THEATRON_LICENCES
    "\"\n"
    "theatron_licences_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
__attribute__((visibility("hidden"))) extern const char theatron_licences_begin[];
__attribute__((visibility("hidden"))) extern const char theatron_licences_end[];
}

namespace theatron::app {

std::string_view licences() {
    return {theatron_licences_begin, theatron_licences_end};
}

}  // namespace theatron::app
