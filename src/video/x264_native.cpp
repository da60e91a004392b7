// SPDX-License-Identifier: Apache-2.0
// x264 through libavcodec, looked up when the program runs.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}

#include <cassert>

#include "ffmpeg/ffmpeg.h"
#include "video/avc_engine_native.h"
#include "video/libavcodec_native.h"

namespace theatron::video {
namespace {

constexpr const char* library_name = "libx264";
// Nominal rate of the encoder; it has an effect only with a bit rate.
constexpr int frames_per_second = 30;

AVPixelFormat pixel_format(AvcLayout layout) {
    switch (layout) {
        case AvcLayout::yuv420:
            return AV_PIX_FMT_YUV420P;
        case AvcLayout::grey8:
            return AV_PIX_FMT_GRAY8;
        case AvcLayout::grey10:
            return AV_PIX_FMT_GRAY10LE;
    }
    return AV_PIX_FMT_NONE;
}

class X264 final : public AvcEngine {
public:
    explicit X264(const AvcParams& params) : params_(params) {}

    Status open(Size size, AvcLayout layout) override;

    Size size() const override {
        return context_ ? Size{context_->width, context_->height} : Size{};
    }

    AvcPlanes planes() override {
        assert(context_);
        // Fails only for want of memory, and then the old buffer stays.
        (void)av_frame_make_writable(frame_.get());
        return planes_of(*frame_);
    }

    Result<AvcEncoder::Encoded> encode(bool key) override;

private:
    const AvcParams params_;
    AvContext context_;
    AvFrame frame_{av_frame_alloc()};
    AvPacket packet_{av_packet_alloc()};
    Bytes bytes_;
    bool first_ = true;
};

Status X264::open(Size size, AvcLayout layout) {
    context_.reset();
    const AVCodec* codec = avcodec_find_encoder_by_name(library_name);
    AvContext context(avcodec_alloc_context3(codec));
    context->log_level_offset = silent;
    context->width = size.width;
    context->height = size.height;
    context->pix_fmt = pixel_format(layout);
    context->time_base = {1, frames_per_second};
    context->framerate = {frames_per_second, 1};
    context->thread_count = 1;
    context->max_b_frames = 0;
    context->refs = 1;
    // The colour space of JPEG, so that decoders elsewhere convert alike.
    context->color_range = AVCOL_RANGE_JPEG;
    context->colorspace = AVCOL_SPC_SMPTE170M;
    context->color_primaries = AVCOL_PRI_BT709;
    context->color_trc = AVCOL_TRC_IEC61966_2_1;
    if (params_.bitrate_mbit > 0) {
        context->bit_rate = std::int64_t(params_.bitrate_mbit * 1e6);
        // A tenth of a second of rate may be waiting: bursts are delay.
        context->rc_max_rate = context->bit_rate;
        context->rc_buffer_size = int(context->bit_rate / 10);
    } else {
        av_opt_set_double(context->priv_data, "crf", params_.crf, 0);
    }
    av_opt_set(context->priv_data, "preset", params_.preset.c_str(), 0);
    av_opt_set(context->priv_data, "tune", "zerolatency", 0);
    av_opt_set_int(context->priv_data, "forced-idr", 1, 0);
    // Key frames come when they are asked for, and only then.
    av_opt_set(context->priv_data, "x264-params", "keyint=infinite:scenecut=0:open-gop=0", 0);
    if (avcodec_open2(context.get(), codec, nullptr) < 0)
        return Status::unsupported;

    av_frame_unref(frame_.get());
    frame_->width = size.width;
    frame_->height = size.height;
    frame_->format = context->pix_fmt;
    frame_->color_range = context->color_range;
    frame_->pts = 0;
    if (av_frame_get_buffer(frame_.get(), 0) < 0)
        return Status::unsupported;
    context_ = std::move(context);
    first_ = true;
    return Status::ok;
}

Result<AvcEncoder::Encoded> X264::encode(bool key) {
    assert(context_);
    const bool want_key = key || first_;
    frame_->pict_type = want_key ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    ++frame_->pts;
    av_packet_unref(packet_.get());
    if (avcodec_send_frame(context_.get(), frame_.get()) < 0 ||
        avcodec_receive_packet(context_.get(), packet_.get()) < 0)
        return Status::unsupported;
    first_ = false;
    keep_picture_units(std::as_bytes(std::span(packet_->data, std::size_t(packet_->size))), bytes_);
    return AvcEncoder::Encoded{bytes_, (packet_->flags & AV_PKT_FLAG_KEY) != 0};
}

}  // namespace

bool has_x264() {
    return ffmpeg::problem().empty() && avcodec_find_encoder_by_name(library_name) != nullptr;
}

std::unique_ptr<AvcEngine> make_x264(const AvcParams& params) {
    return std::make_unique<X264>(params);
}

}  // namespace theatron::video
