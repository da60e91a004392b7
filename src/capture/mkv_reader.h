// SPDX-License-Identifier: Apache-2.0
// Reads an Azure Kinect recording (Matroska) with libavformat: depth as 16-bit big-endian
// values, colour as JPEG, the factory calibration as an attachment. Pictures are returned as
// stored; nothing is decoded.
//
// Runs in a sandbox, because the library is large and files are untrusted. The rest of the
// program uses MkvFile.
#pragma once

#include <memory>
#include <optional>

#include "capture/mkv_answer.h"
#include "capture/source_readers.h"
#include "capture/video_reader.h"
#include "ffmpeg/ffmpeg.h"
#include "sandbox/inside.h"

namespace theatron::capture {

class MkvReader {
public:
    using Kind = MkvAnswer::Kind;

    // Reads from the beginning of the file of `descriptor`, which the caller owns. All functions
    // throw std::bad_alloc if memory is short, and nothing else.
    explicit MkvReader(int descriptor);
    ~MkvReader();

    // Kind::description, or the problem with the file, which then has no pictures.
    Kind kind() const { return kind_; }
    const MkvDescription& description() const;

    struct Picture {
        Kind kind{};  // depth or color
        Duration time{};
        ByteView bytes;  // valid until the next call
    };
    // The next picture, without bytes where a part of the file is damaged; nullopt at the end.
    std::optional<Picture> read();

    // Serves the requests of an MkvFile until the channel closes.
    static void serve(sandbox::Inside& inside);

private:
    struct Library;
    std::unique_ptr<Library> library_;
    Kind kind_;
};

// For run_as_child(): the readers that cameras need.
inline constexpr sandbox::Reader foreign_readers[] = {
    {"mkv", sandbox::Profile::file, MkvReader::serve, ffmpeg::load_if_there},
    {"video", sandbox::Profile::library, serve_video, ffmpeg::load_if_there},
    {"rtsp", sandbox::Profile::stream, serve_rtsp, ffmpeg::load_if_there},
    {"x11", sandbox::Profile::display, serve_x11, ffmpeg::load_if_there},
    {"v4l2", sandbox::Profile::device, serve_v4l2, ffmpeg::load_if_there}};

}  // namespace theatron::capture
