// SPDX-License-Identifier: Apache-2.0
#include "capture/av_video.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>

#include "capture/av_complaints.h"
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

// Formats that say "full range" by another name have the same pixels.
AVPixelFormat without_range(AVPixelFormat format) {
    switch (format) {
        case AV_PIX_FMT_YUVJ411P:
            return AV_PIX_FMT_YUV411P;
        case AV_PIX_FMT_YUVJ420P:
            return AV_PIX_FMT_YUV420P;
        case AV_PIX_FMT_YUVJ422P:
            return AV_PIX_FMT_YUV422P;
        case AV_PIX_FMT_YUVJ440P:
            return AV_PIX_FMT_YUV440P;
        case AV_PIX_FMT_YUVJ444P:
            return AV_PIX_FMT_YUV444P;
        default:
            return format;
    }
}

int coefficients_of(AVColorSpace colors, int rows) {
    if (colors == AVCOL_SPC_UNSPECIFIED)
        return rows > highest_sd_rows ? SWS_CS_ITU709 : SWS_CS_ITU601;
    return colors;  // the library's numbers are the same
}

}  // namespace

bool PictureWriter::begin(Size size) {
    if (!is_valid(size) || size.area() > max_color_pixels || video_bytes(size) > area_.size())
        return false;
    size_ = size;
    return true;
}

void PictureWriter::prepare(const Scaling& scaling) {
    if (scaler_ && scaling == scaling_)
        return;
    sws_freeContext(scaler_);
    scaler_ = sws_getContext(scaling.from.width, scaling.from.height, scaling.format,
                             scaling.to.width, scaling.to.height, AV_PIX_FMT_RGB24, SWS_BILINEAR,
                             nullptr, nullptr, nullptr);
    if (!scaler_)
        throw std::bad_alloc();
    scaling_ = scaling;
    sws_setColorspaceDetails(scaler_, sws_getCoefficients(scaling.colors), scaling.is_full,
                             sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
}

// Writes a picture of the size `to`, not turned.
void PictureWriter::scale(const Source& source, Size to, std::uint8_t* first, int stride) {
    const AVPixelFormat format = without_range(source.format);
    prepare({source.size, to, format, coefficients_of(source.colors, source.size.height),
             source.range == AVCOL_RANGE_JPEG || format != source.format});
    std::uint8_t* const rows[] = {first};
    const int strides[] = {stride};
    sws_scale(scaler_, source.rows, source.strides, 0, source.size.height, rows, strides);
}

void PictureWriter::write(const Source& source) {
    const Size shown = shown_size(source.size, source.shape);
    const Size inner = shown == size_ ? size_ : fitted(shown, size_);
    auto* const first = reinterpret_cast<std::uint8_t*>(area_.data());
    const int stride = 3 * size_.width;
    const int left = (size_.width - inner.width) / 2, top = (size_.height - inner.height) / 2;
    std::uint8_t* const inner_first = first + top * stride + 3 * left;
    const PictureShape& shape = source.shape;
    if (!shape.is_turned()) {
        scale(source, inner, inner_first, stride);
    } else {
        const Size unturned = shape.swapped ? Size{inner.height, inner.width} : inner;
        unturned_.resize(video_bytes(unturned));
        scale(source, unturned, unturned_.data(), 3 * unturned.width);
        for (int y = 0; y < inner.height; ++y)
            for (int x = 0; x < inner.width; ++x) {
                const int across = shape.from_right ? inner.width - 1 - x : x;
                const int down = shape.from_below ? inner.height - 1 - y : y;
                const int pixel =
                    shape.swapped ? across * unturned.width + down : down * unturned.width + across;
                std::copy_n(unturned_.data() + 3 * pixel, 3, inner_first + y * stride + 3 * x);
            }
    }
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

// The matrix maps (x, y) to (m[0] x + m[3] y, m[1] x + m[4] y), with x to the right and y down.
PictureShape shape_of(const std::int32_t* display_matrix, AVRational pixel) {
    PictureShape shape{pixel};
    if (!display_matrix)
        return shape;
    const auto at = [&](int i) { return std::int64_t(display_matrix[i]); };
    shape.swapped = std::abs(at(1)) + std::abs(at(3)) > std::abs(at(0)) + std::abs(at(4));
    shape.from_right = (shape.swapped ? at(3) : at(0)) < 0;
    shape.from_below = (shape.swapped ? at(1) : at(4)) < 0;
    return shape;
}

Size shown_size(Size pixels, const PictureShape& shape) {
    constexpr double most = 10;  // other numbers are mistakes
    double wide = shape.pixel.num > 0 && shape.pixel.den > 0 ? av_q2d(shape.pixel) : 1;
    if (wide > most || wide < 1 / most)
        wide = 1;
    const auto wider = [&] { return Size{int(std::lround(pixels.width * wide)), pixels.height}; };
    const auto higher = [&] { return Size{pixels.width, int(std::lround(pixels.height / wide))}; };
    Size size = wide > 1 ? wider() : higher();
    if (!is_valid(size) || size.area() > max_color_pixels)
        size = wide > 1 ? higher() : wider();
    size = {std::max(size.width, 1), std::max(size.height, 1)};
    return shape.swapped ? Size{size.height, size.width} : size;
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
        return {.kind = why_no_track()};
    const AVStream& track = *file_->streams[track_];
    if (track.disposition & AV_DISPOSITION_ATTACHED_PIC)  // the cover of a file with sound alone
        return {.kind = Kind::no_video};
    const Size own{track.codecpar->width, track.codecpar->height};
    if (own == Size{})
        return {.kind = Kind::damaged};
    if (!is_valid(own) || own.area() > max_color_pixels ||
        !writer_.begin(wanted == Size{} ? shown_size(own, shape(nullptr)) : wanted))
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
    // Damage of the beginning shows in the tracks and their pictures.
    complaints_ = av_complaints();
    if (const double fps = rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0;
        fps >= 0.1 && fps <= 240)
        frames_per_second_ = fps;
    return {Kind::opened, {}, writer_.size(), frames_per_second_};
}

// Where an index is cut off, its tracks have no codec.
VideoAnswer::Kind AvVideo::why_no_track() const {
    if (track_ != AVERROR_DECODER_NOT_FOUND)
        return Kind::no_video;
    const std::span tracks(file_->streams, file_->nb_streams);
    const bool has_codec = std::all_of(tracks.begin(), tracks.end(), [](const AVStream* track) {
        return track->codecpar->codec_type != AVMEDIA_TYPE_VIDEO ||
               track->codecpar->codec_id != AV_CODEC_ID_NONE;
    });
    return has_codec ? Kind::no_decoder : Kind::damaged;
}

// Counts damage between packets as one picture: how many were there is not known.
int AvVideo::read_packet() {
    av_packet_unref(packet_);
    const int failed = av_read_frame(file_, packet_);
    check_av_memory(failed);
    const std::uint64_t complaints = av_complaints();
    const bool is_cut_off = failed < 0 && failed != AVERROR_EOF;
    lost_ += is_cut_off || complaints != complaints_;
    complaints_ = complaints;
    return failed;
}

bool AvVideo::decode() {
    while (decoder_) {
        const int got = avcodec_receive_frame(decoder_, frame_);
        check_av_memory(got);
        if (got == 0 && frame_->width > 0 && frame_->height > 0)
            return true;
        if (got == AVERROR_EOF)
            return false;
        if (got != AVERROR(EAGAIN)) {
            ++lost_;
            if (got < 0 && draining_)
                return false;
            continue;
        }
        const int failed = read_packet();
        if (failed < 0) {
            draining_ = true;
            check_av_memory(avcodec_send_packet(decoder_, nullptr));
        } else if (packet_->stream_index == track_) {
            if (stamps_)
                decoder_->reordered_opaque = stamps_();
            const int sent = avcodec_send_packet(decoder_, packet_);
            check_av_memory(sent);
            lost_ += sent < 0;
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

// The shape of the track, or of a picture that has its own.
PictureShape AvVideo::shape(AVFrame* frame) const {
    AVStream* const track = file_->streams[track_];
    const std::uint8_t* matrix = nullptr;
    std::size_t size = 0;
    if (const AVFrameSideData* own =
            frame ? av_frame_get_side_data(frame, AV_FRAME_DATA_DISPLAYMATRIX) : nullptr) {
        matrix = own->data;
        size = own->size;
    } else {
        matrix = av_stream_get_side_data(track, AV_PKT_DATA_DISPLAYMATRIX, &size);
    }
    std::int32_t numbers[9];
    const bool is_there = matrix && size >= sizeof numbers;
    if (is_there)
        std::memcpy(numbers, matrix, sizeof numbers);
    return shape_of(is_there ? numbers : nullptr,
                    av_guess_sample_aspect_ratio(file_, track, frame));
}

void AvVideo::write() {
    PictureWriter::Source source = source_of(*frame_);
    source.shape = shape(frame_);
    writer_.write(source);
}

}  // namespace theatron::capture
