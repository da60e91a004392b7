// SPDX-License-Identifier: Apache-2.0
#include "capture/video_recording.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "capture/cut_off.h"
#include "ffmpeg/ffmpeg.h"
#include "geometry/screen.h"

namespace theatron::capture {

VideoRecording::VideoRecording(const std::filesystem::path& path)
    : path_(path),
      file_(path),
      child_(ffmpeg::needed_by("video"), file_.descriptor(), "the file " + quoted(path)) {
    opened_ = open();
    if (is_cut_off(file_.descriptor(), file_.bytes()))
        log::warning("capture", "the video is cut off and plays as far as it goes",
                     {{"file", path.string()}});
}

std::optional<Duration> VideoRecording::offset() {
    if (!upcoming_ && !ended_)
        receive();
    return upcoming_;
}

bool VideoRecording::read(Frame& out) {
    out.depth.resize(screen_grid);
    std::fill(out.depth.pixels.begin(), out.depth.pixels.end(), std::uint16_t(screen_distance_mm));
    out.color.jpeg.clear();
    out.color.size = size();
    out.color.pixels.resize(size());
    // The shared memory may change at any time: any bytes are a picture.
    static_assert(sizeof(Rgb) == 3);
    std::memcpy(out.color.pixels.pixels.data(), child_.area().data(), 3 * size().area());
    take();
    return true;
}

std::uint64_t VideoRecording::lost_pictures() const {
    return std::max(lost_before_, lost_);
}

void VideoRecording::rewind() {
    if (waiting_)
        (void)answer();
    lost_before_ = lost_pictures();
    lost_ = 0;
    const VideoAnswer again = open();
    if (again.size != opened_.size)
        throw Error(quoted(path_) + " has changed while it was played.");
}

std::string VideoRecording::problem_at_end() const {
    return is_cut_off(file_.descriptor(), file_.bytes())
               ? "The video " + quoted(path_) + " is cut off."
               : "";
}

VideoAnswer VideoRecording::answer() {
    waiting_ = false;
    const auto answer = decode_video_answer(child_.receive(), child_.area().size());
    if (!answer)
        child_.refuse("one that is " + std::string(to_text(answer.error())));
    return *answer;
}

void VideoRecording::request(VideoRequest what) {
    const auto message = std::byte(what);
    child_.send({&message, 1});
    waiting_ = true;
}

VideoAnswer VideoRecording::open() {
    using Kind = VideoAnswer::Kind;
    request(VideoRequest::open);
    const VideoAnswer opened = answer();
    switch (opened.kind) {
        case Kind::opened:
            break;
        case Kind::unreadable:
            throw Error(quoted(path_) +
                        " is no video that FFmpeg reads, or is damaged at its beginning.");
        case Kind::names_files:
            throw Error(quoted(path_) +
                        " is a list of other files, which are not opened; give the video itself.");
        case Kind::no_video:
            throw Error(quoted(path_) + " has no video track.");
        case Kind::no_decoder:
            throw Error("FFmpeg has no decoder for the video in " + quoted(path_) + ".");
        case Kind::damaged:
            throw Error("The video in " + quoted(path_) +
                        " is cut off or damaged: its index names no codec or no size. Copy it "
                        "again.");
        case Kind::impossible_size:
            throw Error("The video in " + quoted(path_) +
                        " has no size, or is larger than 4096 x 2700 pixels.");
        default:
            child_.refuse("a picture before the description");
    }
    any_ = false;
    upcoming_.reset();
    ended_ = false;
    times_ = {};
    request(VideoRequest::next);
    return opened;
}

void VideoRecording::receive() {
    using Kind = VideoAnswer::Kind;
    const VideoAnswer next = answer();
    lost_ = std::max<std::uint64_t>(lost_, next.lost);
    if (next.kind == Kind::end) {
        ended_ = true;
        if (!any_)
            throw Error(quoted(path_) + " has no picture that can be decoded.");
        return;
    }
    if (next.kind != Kind::picture)
        child_.refuse("no picture");
    any_ = true;
    upcoming_ = times_.due(next.time, seconds_to_duration(1 / frames_per_second()));
    if (times_.jumped() && !std::exchange(jump_noted_, true))
        log::warning("capture", jump_remark, {{"file", path_.string()}});
}

void VideoRecording::take() {
    upcoming_.reset();
    request(VideoRequest::next);
}

}  // namespace theatron::capture
