// SPDX-License-Identifier: Apache-2.0
#include "video/avc_native.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include <cassert>

#include "base/error.h"

namespace theatron::video {
namespace {

constexpr const char* encoder_name = "libx264";
// The encoder is told this rate; it matters only where bits are counted per second.
constexpr int frames_per_second = 30;
// Lifts every message of a context above any level that is printed (the lowest
// eight bits count).
constexpr int silent = 128;
// More than any encoder needs for the largest picture.
constexpr std::size_t max_access_unit = std::size_t(1) << 26;

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

avc::Sequence sequence_of(Size size, AvcLayout layout) {
    return {size, layout == AvcLayout::grey10 ? 10 : 8, layout != AvcLayout::yuv420};
}

// The decoder gives grey as 4:2:0 with empty colour; its first plane is the same.
bool fits(AVPixelFormat found, AvcLayout layout) {
    const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(found);
    if (!format || (format->flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_BE)))
        return false;
    if (format->comp[0].depth != (layout == AvcLayout::grey10 ? 10 : 8) ||
        format->comp[0].plane != 0 || format->comp[0].step != (layout == AvcLayout::grey10 ? 2 : 1))
        return false;
    return layout != AvcLayout::yuv420 ||
           (format->nb_components == 3 && (format->flags & AV_PIX_FMT_FLAG_PLANAR) &&
            format->log2_chroma_w == 1 && format->log2_chroma_h == 1);
}

AvcPlanes planes_of(const AVFrame& frame) {
    AvcPlanes planes;
    for (std::size_t i = 0; i < planes.size(); ++i)
        planes[i] = {frame.data[i], frame.linesize[i]};
    return planes;
}

struct Deleter {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
using Context = std::unique_ptr<AVCodecContext, Deleter>;

}  // namespace

struct AvcEncoder::Library {
    AvcParams params;
    Context context;
    std::unique_ptr<AVFrame, Deleter> frame{av_frame_alloc()};
    std::unique_ptr<AVPacket, Deleter> packet{av_packet_alloc()};
    Bytes bytes;
    bool first = true;
};

AvcEncoder::AvcEncoder(const AvcParams& params) : library_(std::make_unique<Library>()) {
    if (const std::string reason = problem(); !reason.empty())
        throw Error(reason);
    library_->params = params;
}

AvcEncoder::~AvcEncoder() = default;

std::string AvcEncoder::problem() {
    if (avcodec_find_encoder_by_name(encoder_name))
        return "";
    return "There is no H.264 encoder on this machine (its libavcodec is built without x264); "
           "choose another codec.";
}

Status AvcEncoder::open(Size size, AvcLayout layout) {
    Library& l = *library_;
    l.context.reset();
    if (!is_valid(size) || size.area() > avc::max_area)
        return Status::too_large;
    const AVCodec* codec = avcodec_find_encoder_by_name(encoder_name);
    Context context(avcodec_alloc_context3(codec));
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
    if (l.params.bitrate_mbit > 0) {
        context->bit_rate = std::int64_t(l.params.bitrate_mbit * 1e6);
        // A tenth of a second of rate may be waiting: bursts are delay.
        context->rc_max_rate = context->bit_rate;
        context->rc_buffer_size = int(context->bit_rate / 10);
    } else {
        av_opt_set_double(context->priv_data, "crf", l.params.crf, 0);
    }
    av_opt_set(context->priv_data, "preset", l.params.preset.c_str(), 0);
    av_opt_set(context->priv_data, "tune", "zerolatency", 0);
    av_opt_set_int(context->priv_data, "forced-idr", 1, 0);
    // Key frames come when they are asked for, and only then.
    av_opt_set(context->priv_data, "x264-params", "keyint=infinite:scenecut=0:open-gop=0", 0);
    if (avcodec_open2(context.get(), codec, nullptr) < 0)
        return Status::unsupported;

    av_frame_unref(l.frame.get());
    l.frame->width = size.width;
    l.frame->height = size.height;
    l.frame->format = context->pix_fmt;
    l.frame->color_range = context->color_range;
    l.frame->pts = 0;
    if (av_frame_get_buffer(l.frame.get(), 0) < 0)
        return Status::unsupported;
    l.context = std::move(context);
    l.first = true;
    return Status::ok;
}

Size AvcEncoder::size() const {
    const AVCodecContext* context = library_->context.get();
    return context ? Size{context->width, context->height} : Size{};
}

AvcPlanes AvcEncoder::planes() {
    assert(library_->context);
    // Fails only for want of memory, and then the old buffer stays.
    (void)av_frame_make_writable(library_->frame.get());
    return planes_of(*library_->frame);
}

Result<AvcEncoder::Encoded> AvcEncoder::encode(bool key) {
    Library& l = *library_;
    assert(l.context);
    const bool want_key = key || l.first;
    l.frame->pict_type = want_key ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    ++l.frame->pts;
    av_packet_unref(l.packet.get());
    if (avcodec_send_frame(l.context.get(), l.frame.get()) < 0 ||
        avcodec_receive_packet(l.context.get(), l.packet.get()) < 0)
        return Status::unsupported;
    l.first = false;

    // Left out: what the encoder says about itself (some 700 bytes).
    l.bytes.clear();
    ByteView stream = std::as_bytes(std::span(l.packet->data, std::size_t(l.packet->size)));
    while (const auto unit = avc::take_unit(stream))
        if (unit->type() == avc::UnitType::slice || unit->type() == avc::UnitType::idr_slice ||
            unit->type() == avc::UnitType::sequence || unit->type() == avc::UnitType::picture)
            l.bytes.insert(l.bytes.end(), unit->with_start_code.begin(),
                           unit->with_start_code.end());
    return Encoded{l.bytes, (l.packet->flags & AV_PKT_FLAG_KEY) != 0};
}

struct AvcDecoder::Library {
    Context context;
    std::unique_ptr<AVFrame, Deleter> frame{av_frame_alloc()};
    std::unique_ptr<AVPacket, Deleter> packet{av_packet_alloc()};
    std::vector<std::uint8_t> padded;
    bool intact = false;  // the last access unit decoded
    avc::Sequence sequence;

    void open() {
        const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_H264);
        context.reset(avcodec_alloc_context3(codec));
        context->log_level_offset = silent;
        context->thread_count = 1;
        context->flags |= AV_CODEC_FLAG_LOW_DELAY;
        // Half-decoded pictures are not shown. Concealment stays on because only it
        // notices, and says, that a slice ended early.
        context->err_recognition = AV_EF_EXPLODE | AV_EF_BITSTREAM | AV_EF_BUFFER;
        context->max_pixels = std::int64_t(avc::max_area);
        if (avcodec_open2(context.get(), codec, nullptr) < 0)
            context.reset();
    }
};

AvcDecoder::AvcDecoder() : library_(std::make_unique<Library>()) {
    if (const std::string reason = problem(); !reason.empty())
        throw Error(reason);
}

AvcDecoder::~AvcDecoder() = default;

std::string AvcDecoder::problem() {
    if (avcodec_find_decoder(AV_CODEC_ID_H264))
        return "";
    return "There is no H.264 decoder on this machine (its libavcodec is built without); "
           "choose another codec.";
}

Status AvcDecoder::decode(ByteView access_unit, Size size, AvcLayout layout) {
    Library& l = *library_;
    const auto unit = avc::read_access_unit(access_unit);
    const bool was_intact = std::exchange(l.intact, false);
    if (!unit)
        return unit.error();
    if (access_unit.size() > max_access_unit)
        return Status::too_large;
    const avc::Sequence wanted = sequence_of(size, layout);
    if (unit->key) {
        // What damaged headers left behind must not outlive the next key frame.
        l.open();
        if (!l.context)
            return Status::unsupported;
        l.sequence = unit->sequence;
    } else if (!was_intact) {
        return Status::missing_reference;
    }
    if (l.sequence != wanted)
        return Status::size_mismatch;

    // The library reads a little beyond the end.
    l.padded.resize(access_unit.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    std::memcpy(l.padded.data(), access_unit.data(), access_unit.size());
    std::memset(l.padded.data() + access_unit.size(), 0, AV_INPUT_BUFFER_PADDING_SIZE);
    l.packet->data = l.padded.data();
    l.packet->size = int(access_unit.size());
    av_frame_unref(l.frame.get());
    const bool decoded = avcodec_send_packet(l.context.get(), l.packet.get()) >= 0 &&
                         avcodec_receive_frame(l.context.get(), l.frame.get()) >= 0;
    l.packet->data = nullptr;
    l.packet->size = 0;
    if (!decoded || l.frame->decode_error_flags != 0 || (l.frame->flags & AV_FRAME_FLAG_CORRUPT))
        return Status::malformed;
    if (l.frame->width != size.width || l.frame->height != size.height ||
        !fits(AVPixelFormat(l.frame->format), layout))
        return Status::size_mismatch;
    l.intact = true;
    return Status::ok;
}

AvcPlanes AvcDecoder::planes() const {
    return planes_of(*library_->frame);
}

}  // namespace theatron::video
