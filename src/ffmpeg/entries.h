// SPDX-License-Identifier: Apache-2.0
// Where each function of FFmpeg is, once its library is loaded: entries.cpp jumps there.
#pragma once

#include "ffmpeg/functions.h"

#define THEATRON_DECLARE_ENTRY(name) \
    extern "C" __attribute__((visibility("hidden"))) void* theatron_entry_##name;
THEATRON_AVUTIL_FUNCTIONS(THEATRON_DECLARE_ENTRY)
THEATRON_AVCODEC_FUNCTIONS(THEATRON_DECLARE_ENTRY)
THEATRON_AVFORMAT_FUNCTIONS(THEATRON_DECLARE_ENTRY)
THEATRON_SWSCALE_FUNCTIONS(THEATRON_DECLARE_ENTRY)
#undef THEATRON_DECLARE_ENTRY
