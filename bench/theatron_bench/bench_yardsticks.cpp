// SPDX-License-Identifier: Apache-2.0
#include <zstd.h>

#include <cstring>

#include "base/error.h"
#include "bench_coder.h"

#if THEATRON_BENCH_CHARLS
#include <charls/charls.h>
#endif
#if THEATRON_BENCH_FFV1
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}
#endif

namespace theatron {
namespace {

ByteView pixel_bytes(const DepthImage& depth) {
    return std::as_bytes(std::span(depth.pixels));
}

class ZstdRaw final : public BenchCoder {
public:
    ~ZstdRaw() override {
        ZSTD_freeCCtx(compressor_);
        ZSTD_freeDCtx(decompressor_);
    }
    std::string name() const override { return "zstd1_raw"; }
    ByteView encode(const DepthImage& depth, Bytes& out) override {
        const ByteView raw = pixel_bytes(depth);
        out.resize(ZSTD_compressBound(raw.size()));
        return ByteView(out).first(
            ZSTD_compressCCtx(compressor_, out.data(), out.size(), raw.data(), raw.size(), 1));
    }
    bool decode(std::size_t, ByteView encoded, DepthImage& out) override {
        const std::size_t size = 2 * out.size.area();
        return ZSTD_decompressDCtx(decompressor_, out.pixels.data(), size, encoded.data(),
                                   encoded.size()) == size;
    }

private:
    ZSTD_CCtx* compressor_ = ZSTD_createCCtx();
    ZSTD_DCtx* decompressor_ = ZSTD_createDCtx();
};

#if THEATRON_BENCH_CHARLS
class JpegLs final : public BenchCoder {
public:
    std::string name() const override { return "jpegls"; }
    ByteView encode(const DepthImage& depth, Bytes& out) override {
        charls::jpegls_encoder encoder;
        encoder.frame_info(
            {std::uint32_t(depth.size.width), std::uint32_t(depth.size.height), 16, 1});
        out.resize(encoder.estimated_destination_size());
        encoder.destination(out.data(), out.size());
        return ByteView(out).first(encoder.encode(depth.pixels));
    }
    bool decode(std::size_t, ByteView encoded, DepthImage& out) override {
        charls::jpegls_decoder decoder;
        decoder.source(encoded.data(), encoded.size());
        decoder.read_header();
        decoder.decode(out.pixels);
        return true;
    }
};
#endif

#if THEATRON_BENCH_FFV1
// FFV1 version 3, intra frames only, one thread.
class Ffv1 final : public BenchCoder {
public:
    Ffv1() : packet_(av_packet_alloc()), frame_(av_frame_alloc()) {}
    ~Ffv1() override {
        av_packet_free(&packet_);
        av_frame_free(&frame_);
        avcodec_free_context(&encoder_);
        avcodec_free_context(&decoder_);
    }
    std::string name() const override { return "ffv1"; }

    ByteView encode(const DepthImage& depth, Bytes&) override {
        if (encoder_ == nullptr)
            open(depth.size);
        frame_->width = depth.size.width;
        frame_->height = depth.size.height;
        frame_->format = AV_PIX_FMT_GRAY16LE;
        // The library may keep the frame, so each frame has its own memory.
        require(av_frame_get_buffer(frame_, 0) >= 0, "no frame memory");
        for (int y = 0; y < depth.size.height; ++y) {
            std::memcpy(frame_->data[0] + y * std::ptrdiff_t(frame_->linesize[0]),
                        depth.view().row(y), 2 * std::size_t(depth.size.width));
        }
        frame_->pts = pts_++;
        av_packet_unref(packet_);
        require(avcodec_send_frame(encoder_, frame_) >= 0, "a frame was refused");
        av_frame_unref(frame_);
        require(avcodec_receive_packet(encoder_, packet_) >= 0, "a frame gave no packet");
        return std::as_bytes(std::span(packet_->data, std::size_t(packet_->size)));
    }

    bool decode(std::size_t, ByteView encoded, DepthImage& out) override {
        padded_.assign(encoded.begin(), encoded.end());
        padded_.resize(encoded.size() + AV_INPUT_BUFFER_PADDING_SIZE);
        av_packet_unref(packet_);
        packet_->data = reinterpret_cast<std::uint8_t*>(padded_.data());
        packet_->size = int(encoded.size());
        const bool decoded = avcodec_send_packet(decoder_, packet_) >= 0 &&
                             avcodec_receive_frame(decoder_, frame_) >= 0;
        packet_->data = nullptr;
        packet_->size = 0;
        if (!decoded || frame_->width != out.size.width || frame_->height != out.size.height)
            return false;
        for (int y = 0; y < out.size.height; ++y) {
            std::memcpy(out.view().row(y),
                        frame_->data[0] + y * std::ptrdiff_t(frame_->linesize[0]),
                        2 * std::size_t(out.size.width));
        }
        av_frame_unref(frame_);
        return true;
    }

private:
    static void require(bool fine, const char* what) {
        if (!fine)
            throw Error(std::string("The FFV1 yardstick failed: ") + what + ".");
    }

    void open(Size size) {
        const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_FFV1);
        require(codec != nullptr, "this libavcodec has no FFV1 encoder");
        encoder_ = avcodec_alloc_context3(codec);
        encoder_->width = size.width;
        encoder_->height = size.height;
        encoder_->pix_fmt = AV_PIX_FMT_GRAY16LE;
        encoder_->time_base = {1, 30};
        encoder_->gop_size = 1;
        encoder_->level = 3;
        encoder_->thread_count = 1;
        // The default for 16 bits, set explicitly to avoid a warning.
        av_opt_set(encoder_->priv_data, "coder", "range_tab", 0);
        require(avcodec_open2(encoder_, codec, nullptr) >= 0, "the encoder does not open");
        const AVCodec* reader = avcodec_find_decoder(AV_CODEC_ID_FFV1);
        decoder_ = avcodec_alloc_context3(reader);
        decoder_->width = size.width;
        decoder_->height = size.height;
        decoder_->thread_count = 1;
        decoder_->extradata_size = encoder_->extradata_size;
        const std::size_t room =
            std::size_t(encoder_->extradata_size) + AV_INPUT_BUFFER_PADDING_SIZE;
        decoder_->extradata = static_cast<std::uint8_t*>(av_mallocz(room));
        std::memcpy(decoder_->extradata, encoder_->extradata,
                    std::size_t(encoder_->extradata_size));
        require(avcodec_open2(decoder_, reader, nullptr) >= 0, "the decoder does not open");
    }

    AVCodecContext* encoder_ = nullptr;
    AVCodecContext* decoder_ = nullptr;
    AVPacket* packet_;
    AVFrame* frame_;
    std::vector<std::byte> padded_;
    std::int64_t pts_ = 0;
};
#endif

}  // namespace

std::vector<std::unique_ptr<BenchCoder>> zstd_yardstick() {
    std::vector<std::unique_ptr<BenchCoder>> coders;
    coders.push_back(std::make_unique<ZstdRaw>());
    return coders;
}

std::vector<std::unique_ptr<BenchCoder>> depth_yardsticks() {
    std::vector<std::unique_ptr<BenchCoder>> coders = zstd_yardstick();
#if THEATRON_BENCH_CHARLS
    coders.push_back(std::make_unique<JpegLs>());
#endif
#if THEATRON_BENCH_FFV1
    coders.push_back(std::make_unique<Ffv1>());
#endif
    return coders;
}

}  // namespace theatron
