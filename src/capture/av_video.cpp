// SPDX-License-Identifier: Apache-2.0
#include "capture/av_video.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "capture/av_input.h"
#include "geometry/calibration.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

constexpr AVRational microseconds{1, 1'000'000};
// Pictures higher than this have the colours of HD video unless the file says otherwise.
constexpr int highest_sd_rows = 576;

// The largest size of this shape within `most`.
Size fitted(Size shape, Size most) {
    const double scale =
        std::min(double(most.width) / shape.width, double(most.height) / shape.height);
    return {std::clamp(int(shape.width * scale + 0.5), 1, most.width),
            std::clamp(int(shape.height * scale + 0.5), 1, most.height)};
}

bool is_yuv(AVPixelFormat format) {
    return format != AV_PIX_FMT_BGR0 && format != AV_PIX_FMT_RGB24;
}

}  // namespace

bool PictureWriter::begin(Size size) {
    if (!is_valid(size) || size.area() > max_color_pixels || video_bytes(size) > area_.size())
        return false;
    size_ = size;
    return true;
}

void PictureWriter::write(const Source& source) {
    const Size inner = source.size == size_ ? size_ : fitted(source.size, size_);
    SwsContext* const before = scaler_;
    scaler_ = sws_getCachedContext(scaler_, source.size.width, source.size.height, source.format,
                                   inner.width, inner.height, AV_PIX_FMT_RGB24, SWS_BILINEAR,
                                   nullptr, nullptr, nullptr);
    if (!scaler_)
        throw std::bad_alloc();
    if (scaler_ != before && is_yuv(source.format)) {
        const bool is_hd =
            source.colors == AVCOL_SPC_BT709 ||
            (source.colors == AVCOL_SPC_UNSPECIFIED && source.size.height > highest_sd_rows);
        const bool is_full =
            source.range == AVCOL_RANGE_JPEG || source.format == AV_PIX_FMT_YUVJ420P ||
            source.format == AV_PIX_FMT_YUVJ422P || source.format == AV_PIX_FMT_YUVJ444P;
        sws_setColorspaceDetails(
            scaler_, sws_getCoefficients(is_hd ? SWS_CS_ITU709 : SWS_CS_ITU601), is_full,
            sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
    }
    auto* const first = reinterpret_cast<std::uint8_t*>(area_.data());
    const int stride = 3 * size_.width;
    const int left = (size_.width - inner.width) / 2, top = (size_.height - inner.height) / 2;
    std::uint8_t* const rows[] = {first + top * stride + 3 * left};
    const int strides[] = {stride};
    sws_scale(scaler_, source.rows, source.strides, 0, source.size.height, rows, strides);
    if (inner == size_)
        return;
    // The scaler may have written beyond the ends of rows, so the edges follow.
    std::memset(first, 0, std::size_t(top) * std::size_t(stride));
    for (int y = top; y < top + inner.height; ++y) {
        std::memset(first + y * stride, 0, std::size_t(3 * left));
        const int right = left + inner.width;
        std::memset(first + y * stride + 3 * right, 0, std::size_t(3 * (size_.width - right)));
    }
    std::memset(first + (top + inner.height) * stride, 0,
                std::size_t(size_.height - top - inner.height) * std::size_t(stride));
}

PictureWriter::Source source_of(const AVFrame& frame) {
    return {AVPixelFormat(frame.format),
            {frame.width, frame.height},
            frame.data,
            frame.linesize,
            frame.colorspace,
            frame.color_range};
}

AvVideo::AvVideo(std::span<std::byte> area) : writer_(area) {
    if (!packet_ || !frame_)
        throw std::bad_alloc();
}

AvVideo::~AvVideo() {
    av_frame_free(&frame_);
    av_packet_free(&packet_);
    avcodec_free_context(&decoder_);
}

VideoAnswer AvVideo::open(AVFormatContext& file, Size wanted) {
    file_ = &file;
    check_av_memory(avformat_find_stream_info(file_, nullptr));
    const AVCodec* codec = nullptr;
    track_ = av_find_best_stream(file_, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (track_ < 0)
        return {.kind = track_ == AVERROR_DECODER_NOT_FOUND ? Kind::no_decoder : Kind::no_video};
    const AVStream& track = *file_->streams[track_];
    const Size own{track.codecpar->width, track.codecpar->height};
    if (!is_valid(own) || own.area() > max_color_pixels ||
        !writer_.begin(wanted == Size{} ? own : wanted))
        return {.kind = Kind::impossible_size, .size = {}};
    decoder_ = avcodec_alloc_context3(codec);
    if (!decoder_)
        throw std::bad_alloc();
    check_av_memory(avcodec_parameters_to_context(decoder_, track.codecpar));
    decoder_->thread_count = 1;
    decoder_->max_pixels = std::int64_t(max_color_pixels);
    decoder_->pkt_timebase = track.time_base;
    const int failed = avcodec_open2(decoder_, codec, nullptr);
    check_av_memory(failed);
    if (failed)
        return {.kind = Kind::no_decoder};
    const AVRational rate = av_guess_frame_rate(file_, file_->streams[track_], nullptr);
    if (const double fps = rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0;
        fps >= 0.1 && fps <= 240)
        frames_per_second_ = fps;
    return {Kind::opened, {}, writer_.size(), frames_per_second_};
}

bool AvVideo::decode() {
    while (decoder_) {
        const int got = avcodec_receive_frame(decoder_, frame_);
        check_av_memory(got);
        if (got == 0 && frame_->width > 0 && frame_->height > 0)
            return true;
        if (got == AVERROR_EOF || (got < 0 && draining_))
            return false;
        if (got != AVERROR(EAGAIN))
            continue;
        av_packet_unref(packet_);
        const int failed = av_read_frame(file_, packet_);
        check_av_memory(failed);
        if (failed < 0) {
            draining_ = true;
            check_av_memory(avcodec_send_packet(decoder_, nullptr));
        } else if (packet_->stream_index == track_) {
            if (stamps_)
                decoder_->reordered_opaque = stamps_();
            check_av_memory(avcodec_send_packet(decoder_, packet_));
        }
    }
    return false;
}

Duration AvVideo::time() {
    const std::int64_t stamp = frame_->best_effort_timestamp;
    const Duration period = seconds_to_duration(1 / frames_per_second_);
    Duration time = last_ ? *last_ + period : Duration(0);
    if (stamp != AV_NOPTS_VALUE)
        time = Duration(av_rescale_q(stamp, file_->streams[track_]->time_base, microseconds));
    last_ = time;
    return time;
}

void AvVideo::write() {
    writer_.write(source_of(*frame_));
}

}  // namespace theatron::capture
