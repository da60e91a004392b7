// SPDX-License-Identifier: Apache-2.0
// Messages between the process that decodes a video (video_reader.h) and the process that plays it
// (video_camera.h). The video may have compromised the reader, so decoding is safe for any bytes.
#pragma once

#include <cstdint>

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"
#include "image/view.h"

namespace theatron::capture {

enum class VideoRequest : std::uint8_t {
    open = 1,  // read from the beginning; the answer is `opened` or a problem
    next = 2,  // the answer is a picture or the end
    text = 3,  // of live sources (source_camera.h): a part of what open refers to; no answer
};

struct VideoAnswer {
    enum class Kind : std::uint8_t {
        opened = 1,
        picture = 2,  // in the shared memory: rows of red, green, blue bytes, without padding
        end = 3,
        // Problems, instead of `opened`.
        unreadable = 4,
        no_video = 5,
        no_decoder = 6,
        impossible_size = 7,
        refused = 8,       // by the server or the device
        denied = 9,        // user and password are missing or wrong
        hidden = 10,       // the window is closed or minimised
        damaged = 11,      // the track has neither codec nor size
        moved = 12,        // the new address is in the shared memory, before a zero byte
        not_found = 13,    // the server has no such stream
        only_udp = 14,     // the server does not send over its connection
        silent = 15,       // the server
        names_files = 16,  // a list of other files, which are not opened
    };
    Kind kind{};
    Duration time{};  // of the picture; of a live one, of the steady clock
    Size size{};      // of all pictures; only in `opened`
    double frames_per_second = 0;
    std::uint32_t lost = 0;  // of a file: pictures before this answer that could not be decoded
};

Bytes encode(const VideoAnswer& answer);
// Refuses an `opened` whose pictures do not fit into the shared memory.
Result<VideoAnswer> decode_video_answer(ByteView message, std::size_t shared_bytes);

// The bytes that a picture of this size needs in the shared memory: libswscale may write a little
// beyond the last row.
inline std::size_t video_bytes(Size size) {
    return 3 * size.area() + 64;
}

}  // namespace theatron::capture
