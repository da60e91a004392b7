// SPDX-License-Identifier: Apache-2.0
// A USB webcam as its driver shows it: formats, four buffers, pictures at the rate of the format.
//
//   YUYV 640x480    30 pictures a second
//   YUYV 1280x720   10, as on a USB 2 cable
//   MJPEG 1280x720  30
//
// A picture has stripes from left to right: red, green, and blue (YUYV) or magenta (MJPEG). Along
// its bottom a white block moves to the right, a step for each picture.
#pragma once

#include <linux/videodev2.h>

#include <cstddef>
#include <cstdint>

namespace standin {

inline constexpr unsigned most_buffers = 4;
// A multiple of the page size that holds the largest picture.
inline constexpr std::size_t buffer_bytes = std::size_t(2) << 20;

class Device {
public:
    // `memory` has most_buffers * buffer_bytes, which the program maps as the buffers. The device
    // is gone after `pictures`; 0: it stays.
    Device(std::uint8_t* memory, long pictures) : memory_(memory), pictures_left_(pictures) {}

    // 0, or an error number. Knows the requests of a program that captures.
    int control(unsigned long request, void* argument);
    // Milliseconds until a picture is ready: 0 if one is, -1 if none will be.
    int ready_in_ms();
    bool is_gone() const { return gone_; }

private:
    struct Mode {
        std::uint32_t format;
        unsigned width, height, frames_per_second;
    };
    static const Mode modes[];

    void set_format(v4l2_format& format);
    void capture_until(std::int64_t now_us);
    int take(v4l2_buffer& buffer);
    void paint(unsigned index, unsigned number);

    std::uint8_t* memory_;
    long pictures_left_;
    bool gone_ = false;
    const Mode* mode_ = modes;
    unsigned frames_per_second_ = 30;
    bool streams_ = false;
    std::int64_t next_us_ = 0;  // of CLOCK_MONOTONIC: the next exposure
    unsigned number_ = 0;
    struct Buffer {
        unsigned index, number;
        std::int64_t captured_us;
    };
    // In the order in which they were queued and filled.
    Buffer queued_[most_buffers], filled_[most_buffers];
    unsigned queued_count_ = 0, filled_count_ = 0;
    unsigned bytes_used_[most_buffers] = {};
};

}  // namespace standin
