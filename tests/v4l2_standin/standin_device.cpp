// SPDX-License-Identifier: Apache-2.0
#include "standin_device.h"

#include <turbojpeg.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace standin {
namespace {

constexpr unsigned step = 16, block = 64;  // of the moving block, in pixels

struct Color {
    std::uint8_t r, g, b;
};

std::int64_t now_us() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t(time.tv_sec) * 1'000'000 + time.tv_nsec / 1000;
}

Color color_at(unsigned x, unsigned y, unsigned width, unsigned height, unsigned number,
               bool is_jpeg) {
    const unsigned left = number * step % (width - block);
    if (y >= height - block && x >= left && x < left + block)
        return {255, 255, 255};
    constexpr Color blue{0, 0, 255}, magenta{255, 0, 255};
    if (x < width / 3)
        return {255, 0, 0};
    return x < 2 * width / 3 ? Color{0, 255, 0} : is_jpeg ? magenta : blue;
}

// BT.601 in limited range, exact to one step.
std::uint8_t luma(Color c) {
    return std::uint8_t(16 + (66 * c.r + 129 * c.g + 25 * c.b + 128) / 256);
}
std::uint8_t blue_difference(Color c) {
    return std::uint8_t(128 + (-38 * c.r - 74 * c.g + 112 * c.b) / 256);
}
std::uint8_t red_difference(Color c) {
    return std::uint8_t(128 + (112 * c.r - 94 * c.g - 18 * c.b) / 256);
}

}  // namespace

const Device::Mode Device::modes[] = {{V4L2_PIX_FMT_YUYV, 640, 480, 30},
                                      {V4L2_PIX_FMT_YUYV, 1280, 720, 10},
                                      {V4L2_PIX_FMT_MJPEG, 1280, 720, 30}};

int Device::control(unsigned long request, void* argument) {
    if (gone_)
        return ENODEV;
    switch (request) {
        case VIDIOC_QUERYCAP: {
            auto& able = *static_cast<v4l2_capability*>(argument);
            able = {};
            able.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_DEVICE_CAPS;
            able.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
            return 0;
        }
        case VIDIOC_S_FMT:
            if (streams_)
                return EBUSY;
            set_format(*static_cast<v4l2_format*>(argument));
            return 0;
        case VIDIOC_S_PARM: {
            auto& pace = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe;
            const unsigned wanted = pace.numerator ? pace.denominator / pace.numerator : 0;
            frames_per_second_ =
                wanted > 0 && wanted < mode_->frames_per_second ? wanted : mode_->frames_per_second;
            pace = {1, frames_per_second_};
            return 0;
        }
        case VIDIOC_REQBUFS: {
            auto& wanted = *static_cast<v4l2_requestbuffers*>(argument);
            if (wanted.memory != V4L2_MEMORY_MMAP)
                return EINVAL;
            wanted.count = wanted.count < most_buffers ? wanted.count : most_buffers;
            return 0;
        }
        case VIDIOC_QUERYBUF: {
            auto& buffer = *static_cast<v4l2_buffer*>(argument);
            if (buffer.index >= most_buffers)
                return EINVAL;
            buffer.length = buffer_bytes;
            buffer.m.offset = std::uint32_t(buffer.index * buffer_bytes);
            return 0;
        }
        case VIDIOC_QBUF: {
            const auto& buffer = *static_cast<v4l2_buffer*>(argument);
            if (buffer.index >= most_buffers || queued_count_ == most_buffers)
                return EINVAL;
            if (streams_)
                capture_until(now_us());
            queued_[queued_count_++] = {buffer.index, 0, 0};
            return 0;
        }
        case VIDIOC_STREAMON:
            streams_ = true;
            next_us_ = now_us() + 1'000'000 / frames_per_second_;
            return 0;
        case VIDIOC_DQBUF:
            return take(*static_cast<v4l2_buffer*>(argument));
        default:
            return ENOTTY;
    }
}

// The nearest size of this format, as drivers do; the first mode where the format is unknown.
void Device::set_format(v4l2_format& format) {
    v4l2_pix_format& wanted = format.fmt.pix;
    const Mode* best = nullptr;
    const auto distance = [&](const Mode& mode) {
        return std::labs(long(mode.width) * long(mode.height) -
                         long(wanted.width) * long(wanted.height));
    };
    for (const Mode& mode : modes)
        if (mode.format == wanted.pixelformat && (!best || distance(mode) < distance(*best)))
            best = &mode;
    mode_ = best ? best : modes;
    frames_per_second_ = mode_->frames_per_second;
    const bool is_jpeg = mode_->format == V4L2_PIX_FMT_MJPEG;
    wanted.width = mode_->width;
    wanted.height = mode_->height;
    wanted.pixelformat = mode_->format;
    wanted.field = V4L2_FIELD_NONE;
    wanted.bytesperline = is_jpeg ? 0 : 2 * mode_->width;
    wanted.sizeimage = 2 * mode_->width * mode_->height;
    wanted.colorspace = V4L2_COLORSPACE_SRGB;
    wanted.ycbcr_enc = V4L2_YCBCR_ENC_601;
    wanted.quantization = V4L2_QUANTIZATION_DEFAULT;
}

// A picture for which no buffer is queued is lost.
void Device::capture_until(std::int64_t now) {
    for (; next_us_ <= now; next_us_ += 1'000'000 / frames_per_second_, ++number_)
        if (queued_count_ > 0) {
            filled_[filled_count_++] = {queued_[0].index, number_, next_us_};
            std::memmove(queued_, queued_ + 1, --queued_count_ * sizeof(queued_[0]));
        }
}

int Device::ready_in_ms() {
    if (gone_ || !streams_)
        return -1;
    const std::int64_t now = now_us();
    capture_until(now);
    return filled_count_ > 0 ? 0 : int((next_us_ - now) / 1000) + 1;
}

int Device::take(v4l2_buffer& buffer) {
    if (!streams_)
        return EINVAL;
    capture_until(now_us());
    if (filled_count_ == 0)
        return EAGAIN;
    if (pictures_left_ > 0 && --pictures_left_ == 0) {
        gone_ = true;
        return ENODEV;
    }
    const Buffer filled = filled_[0];
    std::memmove(filled_, filled_ + 1, --filled_count_ * sizeof(filled_[0]));
    paint(filled.index, filled.number);
    buffer.index = filled.index;
    buffer.bytesused = bytes_used_[filled.index];
    buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    buffer.timestamp = {filled.captured_us / 1'000'000, filled.captured_us % 1'000'000};
    buffer.sequence = filled.number;
    return 0;
}

void Device::paint(unsigned index, unsigned number) {
    const unsigned width = mode_->width, height = mode_->height;
    std::uint8_t* const out = memory_ + index * buffer_bytes;
    const bool is_jpeg = mode_->format == V4L2_PIX_FMT_MJPEG;
    const auto color = [&](unsigned x, unsigned y) {
        return color_at(x, y, width, height, number, is_jpeg);
    };
    if (!is_jpeg) {
        // Two pixels have one colour.
        for (unsigned y = 0; y < height; ++y)
            for (unsigned x = 0; x < width; x += 2) {
                const Color c = color(x, y);
                std::uint8_t* const pair = out + 2 * (y * width + x);
                pair[0] = luma(c);
                pair[1] = blue_difference(c);
                pair[2] = luma(color(x + 1, y));
                pair[3] = red_difference(c);
            }
        bytes_used_[index] = 2 * width * height;
        return;
    }
    auto* const pixels = static_cast<std::uint8_t*>(std::malloc(3 * width * height));
    for (unsigned i = 0; pixels && i < width * height; ++i) {
        const Color c = color(i % width, i / width);
        std::memcpy(pixels + 3 * i, &c, 3);
    }
    unsigned char* coded = out;
    unsigned long size = buffer_bytes;
    void* const jpeg = tjInitCompress();
    const bool good = pixels && jpeg &&
                      tjCompress2(jpeg, pixels, int(width), 0, int(height), TJPF_RGB, &coded, &size,
                                  TJSAMP_422, 90, TJFLAG_NOREALLOC) == 0;
    bytes_used_[index] = good ? unsigned(size) : 0;
    tjDestroy(jpeg);
    std::free(pixels);
}

}  // namespace standin
