// SPDX-License-Identifier: Apache-2.0
// Each function of FFmpeg that is called, as a jump to its place in the loaded library.
//
// A jump keeps all arguments where they are, so no signature is repeated here.
#include "ffmpeg/entries.h"

#include <cstdio>
#include <cstdlib>

namespace {

[[noreturn]] void not_loaded() {
    std::fputs("theatron: a function of FFmpeg was called before its libraries were loaded.\n",
               stderr);
    std::abort();
}

}  // namespace

#if defined(__x86_64__)
#define THEATRON_JUMP(name) "jmp *theatron_entry_" #name "(%rip)\n"
#elif defined(__aarch64__)
#define THEATRON_JUMP(name)                       \
    "adrp x16, theatron_entry_" #name             \
    "\n"                                          \
    "ldr x16, [x16, #:lo12:theatron_entry_" #name \
    "]\n"                                         \
    "br x16\n"
#else
#error "This processor needs its own jump here."
#endif

#define THEATRON_ENTRY(name)                                                        \
    extern "C" {                                                                    \
    void* theatron_entry_##name = reinterpret_cast<void*>(&not_loaded);             \
    }                                                                               \
    asm(".pushsection .text\n.globl " #name "\n.hidden " #name "\n.type " #name     \
        ", %function\n" #name ":\n" THEATRON_JUMP(name) ".size " #name ", .-" #name \
                                                        "\n.popsection\n");
THEATRON_AVUTIL_FUNCTIONS(THEATRON_ENTRY)
THEATRON_AVCODEC_FUNCTIONS(THEATRON_ENTRY)
THEATRON_AVFORMAT_FUNCTIONS(THEATRON_ENTRY)
THEATRON_SWSCALE_FUNCTIONS(THEATRON_ENTRY)
