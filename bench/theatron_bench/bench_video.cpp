// SPDX-License-Identifier: Apache-2.0
#include "bench_video.h"

#include "base/error.h"
#include "base/options.h"

#if THEATRON_BENCH_FFV1
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}
#include <turbojpeg.h>

#include <array>
#include <chrono>
#include <thread>

#include "video/camera_pixels_native.h"
#endif

namespace theatron::bench {

bool is_video_yardstick(const std::string& codec) {
    const std::string kind = Options::parse(codec).kind();
    return kind == "vp8" || kind == "vp9" || kind == "av1" || kind == "svtav1";
}

#if THEATRON_BENCH_FFV1
namespace {

struct Deleter {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
using Context = std::unique_ptr<AVCodecContext, Deleter>;

[[noreturn]] void fail(const std::string& codec) {
    throw Error("libavcodec does not do '" + codec + "' here.");
}

// Some libraries work on threads of their own: the picture comes a little later.
template <class Receive>
bool wait_for(const Receive& receive) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    int result;
    while ((result = receive()) == AVERROR(EAGAIN) && std::chrono::steady_clock::now() < deadline)
        std::this_thread::yield();
    return result >= 0;
}

std::pair<std::array<unsigned char*, 3>, std::array<int, 3>> planes_of(const AVFrame& frame) {
    return {{frame.data[0], frame.data[1], frame.data[2]},
            {frame.linesize[0], frame.linesize[1], frame.linesize[2]}};
}

class Encoder final : public video::ColorEncoder {
public:
    explicit Encoder(const std::string& codec) : codec_(codec) {}
    ~Encoder() override { tjDestroy(converter_); }

    Result<video::EncodedColor> encode(const ColorData& color, bool key) override {
        const auto image = pixels_.of(color);
        if (!image)
            return image.error();
        if (!context_)
            open(image->size);
        (void)av_frame_make_writable(frame_.get());
        auto [planes, strides] = planes_of(*frame_);
        tjEncodeYUVPlanes(converter_, reinterpret_cast<const unsigned char*>(image->pixels),
                          image->size.width, int(image->stride) * 3, image->size.height, TJPF_RGB,
                          planes.data(), strides.data(), TJSAMP_420, 0);
        frame_->pict_type = key ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
        ++frame_->pts;
        av_packet_unref(packet_.get());
        if (avcodec_send_frame(context_.get(), frame_.get()) < 0 ||
            !wait_for([&] { return avcodec_receive_packet(context_.get(), packet_.get()); }))
            throw Error("'" + codec_ + "' gives no picture back before it has seen later ones.");
        return video::EncodedColor{
            std::as_bytes(std::span(packet_->data, std::size_t(packet_->size))),
            (packet_->flags & AV_PKT_FLAG_KEY) != 0};
    }

private:
    void open(Size size) {
        Options options = Options::parse(codec_);
        const std::string kind = options.kind();
        const AVCodec* found = avcodec_find_encoder_by_name(kind == "vp8"   ? "libvpx"
                                                            : kind == "vp9" ? "libvpx-vp9"
                                                            : kind == "av1" ? "libaom-av1"
                                                                            : "libsvtav1");
        if (!found)
            fail(codec_);
        context_.reset(avcodec_alloc_context3(found));
        context_->width = size.width;
        context_->height = size.height;
        context_->pix_fmt = AV_PIX_FMT_YUV420P;
        context_->color_range = AVCOL_RANGE_JPEG;
        context_->time_base = {1, 30};
        context_->framerate = {30, 1};
        context_->thread_count = 1;
        context_->gop_size = 9999;
        context_->max_b_frames = 0;
        const int q = options.take_int("q", 30, 4, 63);
        void* own = context_->priv_data;
        if (kind == "av1") {
            av_opt_set(own, "usage", "realtime", 0);
            av_opt_set_int(own, "cpu-used", 9, 0);
            av_opt_set_int(own, "lag-in-frames", 0, 0);
            av_opt_set_int(own, "crf", q, 0);
        } else if (kind == "svtav1") {
            av_opt_set_int(own, "preset", 12, 0);
            av_opt_set_int(own, "crf", q, 0);
            av_opt_set(own, "svtav1-params", "pred-struct=1:lp=1:scm=0:lookahead=0", 0);
        } else {
            context_->qmin = context_->qmax = q;
            context_->bit_rate = 100'000'000;
            av_opt_set(own, "deadline", "realtime", 0);
            av_opt_set_int(own, "cpu-used", 8, 0);
            av_opt_set_int(own, "lag-in-frames", 0, 0);
        }
        options.require_no_problem();
        av_log_set_level(AV_LOG_ERROR);
        if (avcodec_open2(context_.get(), found, nullptr) < 0)
            fail(codec_);
        frame_->width = size.width;
        frame_->height = size.height;
        frame_->format = context_->pix_fmt;
        frame_->color_range = context_->color_range;
        frame_->pts = 0;
        if (av_frame_get_buffer(frame_.get(), 0) < 0)
            fail(codec_);
    }

    const std::string codec_;
    tjhandle converter_ = tjInitCompress();
    video::CameraPixels pixels_;
    Context context_;
    std::unique_ptr<AVFrame, Deleter> frame_{av_frame_alloc()};
    std::unique_ptr<AVPacket, Deleter> packet_{av_packet_alloc()};
};

class Decoder final : public video::ColorDecoder {
public:
    explicit Decoder(const std::string& codec) {
        const std::string kind = Options::parse(codec).kind();
        const AVCodec* found =
            kind.ends_with("av1")
                ? avcodec_find_decoder_by_name("libdav1d")
                : avcodec_find_decoder(kind == "vp8" ? AV_CODEC_ID_VP8 : AV_CODEC_ID_VP9);
        if (!found)
            fail(codec);
        context_.reset(avcodec_alloc_context3(found));
        context_->thread_count = 1;
        context_->flags |= AV_CODEC_FLAG_LOW_DELAY;
        if (avcodec_open2(context_.get(), found, nullptr) < 0)
            fail(codec);
    }
    ~Decoder() override { tjDestroy(converter_); }

    Status submit(ByteView encoded, FrameNumber number) override {
        padded_.assign(encoded.size() + AV_INPUT_BUFFER_PADDING_SIZE, 0);
        std::memcpy(padded_.data(), encoded.data(), encoded.size());
        packet_->data = padded_.data();
        packet_->size = int(encoded.size());
        const bool decoded =
            avcodec_send_packet(context_.get(), packet_.get()) >= 0 &&
            wait_for([&] { return avcodec_receive_frame(context_.get(), frame_.get()); });
        packet_->data = nullptr;
        packet_->size = 0;
        if (!decoded)
            return Status::malformed;
        decoded_.frame = number;
        decoded_.image.resize({frame_->width, frame_->height});
        const auto [planes, strides] = planes_of(*frame_);
        const unsigned char* from[] = {planes[0], planes[1], planes[2]};
        tjDecodeYUVPlanes(converter_, from, strides.data(), TJSAMP_420,
                          &decoded_.image.pixels.data()->r, frame_->width, frame_->width * 3,
                          frame_->height, TJPF_RGB, 0);
        av_frame_unref(frame_.get());
        ready_ = true;
        return Status::ok;
    }
    std::optional<Decoded> poll() override {
        if (!std::exchange(ready_, false))
            return std::nullopt;
        return std::move(decoded_);
    }
    void recycle(ColorImage image) override { decoded_.image = std::move(image); }

private:
    tjhandle converter_ = tjInitDecompress();
    Context context_;
    std::unique_ptr<AVFrame, Deleter> frame_{av_frame_alloc()};
    std::unique_ptr<AVPacket, Deleter> packet_{av_packet_alloc()};
    std::vector<std::uint8_t> padded_;
    Decoded decoded_;
    bool ready_ = false;
};

}  // namespace

std::unique_ptr<video::ColorEncoder> make_video_encoder(const std::string& codec) {
    return std::make_unique<Encoder>(codec);
}

std::unique_ptr<video::ColorDecoder> make_video_decoder(const std::string& codec) {
    return std::make_unique<Decoder>(codec);
}
#else
std::unique_ptr<video::ColorEncoder> make_video_encoder(const std::string& codec) {
    throw Error("This build has no yardstick '" + codec + "'.");
}

std::unique_ptr<video::ColorDecoder> make_video_decoder(const std::string& codec) {
    throw Error("This build has no yardstick '" + codec + "'.");
}
#endif

}  // namespace theatron::bench
