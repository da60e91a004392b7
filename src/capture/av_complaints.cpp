// SPDX-License-Identifier: Apache-2.0
#include "capture/av_complaints.h"

extern "C" {
#include <libavutil/log.h>
}

#include <atomic>
#include <cstdarg>

namespace theatron::capture {
namespace {

std::atomic<std::uint64_t> complaints = 0;

void note(void* object, int level, const char*, va_list) {
    if (level > AV_LOG_ERROR || !object)
        return;
    const AVClass* const kind = *static_cast<const AVClass**>(object);
    if (!kind)
        return;
    const AVClassCategory category =
        kind->get_category ? kind->get_category(object) : kind->category;
    // Decoders complain about pictures, which are counted where they are lost.
    complaints += category == AV_CLASS_CATEGORY_DEMUXER;
}

}  // namespace

void count_av_complaints() {
    av_log_set_callback(note);
}

std::uint64_t av_complaints() {
    return complaints;
}

}  // namespace theatron::capture
