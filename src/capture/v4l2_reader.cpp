// SPDX-License-Identifier: Apache-2.0
// Pictures of a video device (V4L2): uncompressed ones and JPEG.
extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/log.h>
}

#include <errno.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <cmath>
#include <cstring>
#include <new>
#include <tuple>
#include <vector>

#include "base/steady_clock.h"
#include "capture/av_input.h"
#include "capture/av_video.h"
#include "capture/source_readers.h"
#include "capture/source_request.h"
#include "geometry/calibration.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

constexpr unsigned buffers_wanted = 4;
// The largest that is asked for without a wish; a driver answers with what is nearest.
constexpr Size usual_size{1920, 1080};
// Share of the wanted rate that is enough.
constexpr double enough_rate = 0.9;
constexpr std::size_t largest_buffer = std::size_t(64) << 20;

struct Format {
    std::uint32_t device;
    AVPixelFormat pixels;  // none: JPEG
    int planes;
};
// In the order of preference: without loss first.
constexpr Format formats[] = {
    {V4L2_PIX_FMT_YUYV, AV_PIX_FMT_YUYV422, 1}, {V4L2_PIX_FMT_UYVY, AV_PIX_FMT_UYVY422, 1},
    {V4L2_PIX_FMT_NV12, AV_PIX_FMT_NV12, 2},    {V4L2_PIX_FMT_YUV420, AV_PIX_FMT_YUV420P, 3},
    {V4L2_PIX_FMT_RGB24, AV_PIX_FMT_RGB24, 1},  {V4L2_PIX_FMT_MJPEG, AV_PIX_FMT_NONE, 0},
    {V4L2_PIX_FMT_JPEG, AV_PIX_FMT_NONE, 0}};

class Device {
public:
    Device(const SourceOpening& opening, sandbox::Inside& inside)
        : opening_(opening), descriptor_(inside.input()), writer_(inside.area()) {}
    ~Device() {
        av_frame_free(&frame_);
        av_packet_free(&packet_);
        avcodec_free_context(&jpeg_);
    }
    Device(const Device&) = delete;

    VideoAnswer open();
    std::optional<VideoAnswer> next();

private:
    bool ask(unsigned long request, void* argument) const {
        int result;
        do {
            result = ioctl(descriptor_, request, argument);
        } while (result < 0 && errno == EINTR);
        return result == 0;
    }
    bool choose_format();
    bool choose(const Format& format, Size size);
    bool take_newest(v4l2_buffer& buffer) const;
    bool map_buffers();
    bool write_picture(const std::uint8_t* bytes, std::size_t count);

    SourceOpening opening_;
    int descriptor_;
    PictureWriter writer_;
    const Format* format_ = nullptr;
    Size size_;
    int stride_ = 0;
    double frames_per_second_ = 0;
    AVColorSpace colors_ = AVCOL_SPC_UNSPECIFIED;
    AVColorRange range_ = AVCOL_RANGE_UNSPECIFIED;
    std::vector<std::span<const std::uint8_t>> buffers_;
    AVCodecContext* jpeg_ = nullptr;
    AVPacket* packet_ = nullptr;
    AVFrame* frame_ = nullptr;
};

AVColorSpace colors_of(const v4l2_pix_format& told) {
    std::uint32_t encoding = told.ycbcr_enc;
    if (encoding == V4L2_YCBCR_ENC_DEFAULT)
        encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(told.colorspace);
    return encoding == V4L2_YCBCR_ENC_709 || encoding == V4L2_YCBCR_ENC_XV709 ? AVCOL_SPC_BT709
                                                                              : AVCOL_SPC_SMPTE170M;
}

AVColorRange range_of(const v4l2_pix_format& told) {
    const bool is_full =
        told.quantization == V4L2_QUANTIZATION_FULL_RANGE ||
        (told.quantization == V4L2_QUANTIZATION_DEFAULT && told.colorspace == V4L2_COLORSPACE_JPEG);
    return is_full ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
}

// Sets the format and the rate of the device.
bool Device::choose(const Format& format, Size size) {
    v4l2_format wanted{};
    wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    wanted.fmt.pix.width = unsigned(size.width);
    wanted.fmt.pix.height = unsigned(size.height);
    wanted.fmt.pix.pixelformat = format.device;
    wanted.fmt.pix.field = V4L2_FIELD_ANY;
    if (!ask(VIDIOC_S_FMT, &wanted) || wanted.fmt.pix.pixelformat != format.device ||
        wanted.fmt.pix.width == 0 || wanted.fmt.pix.width > unsigned(max_side) ||
        wanted.fmt.pix.height == 0 || wanted.fmt.pix.height > unsigned(max_side))
        return false;
    size_ = {int(wanted.fmt.pix.width), int(wanted.fmt.pix.height)};
    stride_ = int(std::min(wanted.fmt.pix.bytesperline, unsigned(8 * max_side)));
    format_ = &format;
    colors_ = colors_of(wanted.fmt.pix);
    range_ = range_of(wanted.fmt.pix);
    v4l2_streamparm pace{};
    pace.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    pace.parm.capture.timeperframe = {1, std::uint32_t(std::lround(opening_.frames_per_second))};
    frames_per_second_ = opening_.frames_per_second;
    if (const auto& told = pace.parm.capture.timeperframe;
        ask(VIDIOC_S_PARM, &pace) && told.numerator > 0 && told.denominator > 0)
        frames_per_second_ = double(told.denominator) / told.numerator;
    return true;
}

// The right size comes before the rate, and both before pictures without loss: many devices give
// those only slowly, since a cable carries no more.
bool Device::choose_format() {
    const Size size = opening_.wanted == Size{} ? usual_size : opening_.wanted;
    const Format* best = nullptr;
    std::tuple<bool, std::size_t, double> best_value;
    for (const Format& format : formats) {
        if (!choose(format, size))
            continue;
        const std::tuple value{
            size_ == size, std::min(size_.area(), size.area()),
            std::min(frames_per_second_, enough_rate * opening_.frames_per_second)};
        if (!best || value > best_value) {
            best = &format;
            best_value = value;
        }
    }
    return best && choose(*best, size);
}

bool Device::map_buffers() {
    v4l2_requestbuffers wanted{};
    wanted.count = buffers_wanted;
    wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    wanted.memory = V4L2_MEMORY_MMAP;
    if (!ask(VIDIOC_REQBUFS, &wanted) || wanted.count < 2)
        return false;
    for (unsigned i = 0; i < std::min(wanted.count, 2 * buffers_wanted); ++i) {
        v4l2_buffer buffer{};
        buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        buffer.memory = V4L2_MEMORY_MMAP;
        buffer.index = i;
        if (!ask(VIDIOC_QUERYBUF, &buffer) || buffer.length > largest_buffer)
            return false;
        void* const memory =
            mmap(nullptr, buffer.length, PROT_READ, MAP_SHARED, descriptor_, buffer.m.offset);
        if (memory == MAP_FAILED || !ask(VIDIOC_QBUF, &buffer))
            return false;
        buffers_.push_back({static_cast<const std::uint8_t*>(memory), buffer.length});
    }
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    return ask(VIDIOC_STREAMON, &type);
}

VideoAnswer Device::open() {
    av_log_set_level(AV_LOG_QUIET);
    if (!choose_format())
        return {.kind = Kind::no_decoder};
    if (!writer_.begin(opening_.wanted == Size{} ? size_ : opening_.wanted))
        return {.kind = Kind::impossible_size};
    if (format_->pixels == AV_PIX_FMT_NONE) {
        const AVCodec* const codec = avcodec_find_decoder(AV_CODEC_ID_MJPEG);
        jpeg_ = codec ? avcodec_alloc_context3(codec) : nullptr;
        packet_ = av_packet_alloc();
        frame_ = av_frame_alloc();
        if (!jpeg_ || !packet_ || !frame_)
            throw std::bad_alloc();
        jpeg_->thread_count = 1;
        jpeg_->max_pixels = std::int64_t(max_color_pixels);
        if (avcodec_open2(jpeg_, codec, nullptr) < 0)
            return {.kind = Kind::no_decoder};
    }
    if (!map_buffers())
        return {.kind = Kind::refused};
    return {Kind::opened, {}, writer_.size(), frames_per_second_};
}

// False if the picture is damaged.
bool Device::write_picture(const std::uint8_t* bytes, std::size_t count) {
    if (jpeg_) {
        check_av_memory(av_new_packet(packet_, int(count)));
        std::memcpy(packet_->data, bytes, count);
        const int sent = avcodec_send_packet(jpeg_, packet_);
        av_packet_unref(packet_);
        check_av_memory(sent);
        if (sent < 0 || avcodec_receive_frame(jpeg_, frame_) < 0)
            return false;
        writer_.write(source_of(*frame_));
        return true;
    }
    const std::uint8_t* rows[4] = {bytes};
    int strides[4] = {stride_};
    const auto luma = std::size_t(stride_) * std::size_t(size_.height);
    std::size_t needed = luma;
    if (format_->planes == 2) {
        rows[1] = bytes + luma;
        strides[1] = stride_;
        needed += luma / 2;
    } else if (format_->planes == 3) {
        rows[1] = bytes + luma;
        rows[2] = rows[1] + luma / 4;
        strides[1] = strides[2] = stride_ / 2;
        needed += luma / 2;
    }
    if (count < needed ||
        std::size_t(stride_) < std::size_t(av_image_get_linesize(format_->pixels, size_.width, 0)))
        return false;
    writer_.write({format_->pixels, size_, rows, strides, colors_, range_});
    return true;
}

// Older pictures that wait are left out: the driver keeps up to four. False: no picture.
bool Device::take_newest(v4l2_buffer& buffer) const {
    const auto take = [&](v4l2_buffer& one) {
        one = {};
        one.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        one.memory = V4L2_MEMORY_MMAP;
        return ask(VIDIOC_DQBUF, &one);
    };
    if (!take(buffer))
        return false;
    for (v4l2_buffer later; take(later); buffer = later)
        if (!ask(VIDIOC_QBUF, &buffer))
            return false;
    return true;
}

std::optional<VideoAnswer> Device::next() {
    while (true) {
        pollfd ready{descriptor_, POLLIN, 0};
        if (poll(&ready, 1, 1000) < 0 && errno != EINTR)
            return std::nullopt;
        if (ready.revents & (POLLERR | POLLHUP | POLLNVAL))
            return std::nullopt;
        if (!(ready.revents & POLLIN))
            continue;
        v4l2_buffer buffer{};
        if (!take_newest(buffer)) {
            if (errno == EAGAIN)
                continue;
            return std::nullopt;
        }
        if (buffer.index >= buffers_.size())
            return std::nullopt;
        const auto memory = buffers_[buffer.index];
        const TimePoint now = steady_now();
        TimePoint captured = now;
        // The driver's time of the exposure or of the arrival, where its clock is this one.
        if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
            captured = std::min(now, from_us(std::int64_t(buffer.timestamp.tv_sec) * 1'000'000 +
                                             buffer.timestamp.tv_usec));
        const bool is_good =
            !(buffer.flags & V4L2_BUF_FLAG_ERROR) &&
            write_picture(memory.data(), std::min<std::size_t>(buffer.bytesused, memory.size()));
        if (!ask(VIDIOC_QBUF, &buffer))
            return std::nullopt;
        if (is_good)
            return VideoAnswer{
                .kind = Kind::picture, .time = Duration(to_us(captured)), .size = {}};
    }
}

}  // namespace

void serve_v4l2(sandbox::Inside& inside) {
    serve_source<Device>(inside);
}

}  // namespace theatron::capture
