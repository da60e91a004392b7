// SPDX-License-Identifier: Apache-2.0
#include "video/avc_native.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <cassert>

#include "base/error.h"
#include "ffmpeg/ffmpeg.h"
#include "video/avc_engine_native.h"
#include "video/libavcodec_native.h"

namespace theatron::video {
namespace {

// More than any encoder needs for the largest picture.
constexpr std::size_t max_access_unit = std::size_t(1) << 26;

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

}  // namespace

AvcEncoder::AvcEncoder(const AvcParams& params) : params_(params) {
    const std::string name = params.encoder.empty() ? best_encoder() : params.encoder;
    if (const std::string reason = problem(name); !reason.empty())
        throw Error(reason);
    engine_ = name == openh264_name ? make_openh264(params) : make_x264(params);
}

AvcEncoder::~AvcEncoder() = default;

std::string AvcEncoder::best_encoder() {
    return has_openh264() ? openh264_name : has_x264() ? x264_name : "";
}

std::string AvcEncoder::problem(const std::string& encoder) {
    const std::string name = encoder.empty() ? best_encoder() : encoder;
    if (name.empty())
        return "There is no H.264 encoder on this machine (its libavcodec is built without x264, "
               "and "
               "there is no OpenH264); choose another codec.";
    if (name == openh264_name ? has_openh264() : has_x264())
        return "";
    return "There is no H.264 encoder '" + name + "' on this machine" +
           (name == x264_name ? " (its libavcodec is built without it)" : "") +
           "; choose another one or another codec.";
}

void keep_picture_units(ByteView stream, Bytes& out) {
    out.clear();
    while (const auto unit = avc::take_unit(stream))
        if (unit->type() == avc::UnitType::slice || unit->type() == avc::UnitType::idr_slice ||
            unit->type() == avc::UnitType::sequence || unit->type() == avc::UnitType::picture)
            out.insert(out.end(), unit->with_start_code.begin(), unit->with_start_code.end());
}

Status AvcEncoder::open(Size size, AvcLayout layout) {
    if (!is_valid(size) || size.area() > avc::max_area)
        return Status::too_large;
    const Status status = engine_->open(size, layout);
    if (status != Status::unsupported || !params_.encoder.empty() || !has_x264())
        return status;
    // OpenH264 takes no very small pictures.
    params_.encoder = x264_name;
    engine_ = make_x264(params_);
    return engine_->open(size, layout);
}

Size AvcEncoder::size() const {
    return engine_->size();
}

AvcPlanes AvcEncoder::planes() {
    return engine_->planes();
}

Result<AvcEncoder::Encoded> AvcEncoder::encode(bool key) {
    return engine_->encode(key);
}

struct AvcDecoder::Library {
    AvContext context;
    AvFrame frame{av_frame_alloc()};
    AvPacket packet{av_packet_alloc()};
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

AvcDecoder::AvcDecoder() {
    if (const std::string reason = problem(); !reason.empty())
        throw Error(reason);
    library_ = std::make_unique<Library>();
}

AvcDecoder::~AvcDecoder() = default;

std::string AvcDecoder::problem() {
    if (!ffmpeg::problem().empty())
        return "There is no H.264 decoder on this machine (" + ffmpeg::problem() +
               "); choose another codec.";
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
        // State that damaged headers left in the decoder must not outlive the next key frame.
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
