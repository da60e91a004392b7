// SPDX-License-Identifier: Apache-2.0
// The parts of libavcodec that H.264 encoding and decoding share. Native builds only.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
}

#include <memory>

#include "video/avc_native.h"

namespace theatron::video {

// Lifts every message of a context above any level that is printed (the lowest
// eight bits count).
inline constexpr int silent = 128;

struct AvDeleter {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
using AvContext = std::unique_ptr<AVCodecContext, AvDeleter>;
using AvFrame = std::unique_ptr<AVFrame, AvDeleter>;
using AvPacket = std::unique_ptr<AVPacket, AvDeleter>;

inline AvcPlanes planes_of(const AVFrame& frame) {
    AvcPlanes planes;
    for (std::size_t i = 0; i < planes.size(); ++i)
        planes[i] = {frame.data[i], frame.linesize[i]};
    return planes;
}

}  // namespace theatron::video
