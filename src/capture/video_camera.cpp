// SPDX-License-Identifier: Apache-2.0
#include "capture/video_camera.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/lasting_error.h"
#include "capture/playback.h"
#include "capture/readable_file.h"
#include "capture/source_camera.h"
#include "capture/video_answer.h"
#include "ffmpeg/ffmpeg.h"
#include "geometry/screen.h"
#include "sandbox/child.h"

namespace theatron::capture {
namespace {

using Kind = VideoAnswer::Kind;

// A video that a sandboxed process decodes, one picture ahead.
class VideoRecording final : public Recording {
public:
    explicit VideoRecording(const std::filesystem::path& path)
        : path_(path),
          file_(path),
          child_(ffmpeg::needed_by("video"), file_.descriptor(), "the file " + quoted(path)) {
        opened_ = open();
    }

    Size size() const { return opened_.size; }
    double frames_per_second() const { return opened_.frames_per_second; }

    std::optional<Duration> offset() override {
        if (!upcoming_ && !ended_)
            receive();
        return upcoming_;
    }

    void skip() override { take(); }

    bool read(Frame& out) override {
        out.depth.resize(screen_grid);
        std::fill(out.depth.pixels.begin(), out.depth.pixels.end(),
                  std::uint16_t(screen_distance_mm));
        out.color.jpeg.clear();
        out.color.size = size();
        out.color.pixels.resize(size());
        // The shared memory may change at any time: any bytes are a picture.
        static_assert(sizeof(Rgb) == 3);
        std::memcpy(out.color.pixels.pixels.data(), child_.area().data(), 3 * size().area());
        take();
        return true;
    }

    std::uint64_t lost_pictures() const override { return std::max(lost_before_, lost_); }

    void rewind() override {
        if (waiting_)
            (void)answer();
        lost_before_ = lost_pictures();
        lost_ = 0;
        const VideoAnswer again = open();
        if (again.size != opened_.size)
            throw Error(quoted(path_) + " has changed while it was played.");
    }

private:
    VideoAnswer answer() {
        waiting_ = false;
        const auto answer = decode_video_answer(child_.receive(), child_.area().size());
        if (!answer)
            child_.refuse("one that is " + std::string(to_text(answer.error())));
        return *answer;
    }

    void request(VideoRequest what) {
        const auto message = std::byte(what);
        child_.send({&message, 1});
        waiting_ = true;
    }

    VideoAnswer open() {
        request(VideoRequest::open);
        const VideoAnswer opened = answer();
        switch (opened.kind) {
            case Kind::opened:
                break;
            case Kind::unreadable:
                throw Error(quoted(path_) +
                            " is no video that FFmpeg reads, or is damaged at its beginning.");
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
        first_.reset();
        upcoming_.reset();
        ended_ = false;
        last_ = {};
        request(VideoRequest::next);
        return opened;
    }

    void receive() {
        const VideoAnswer next = answer();
        lost_ = std::max<std::uint64_t>(lost_, next.lost);
        if (next.kind == Kind::end) {
            ended_ = true;
            if (!first_)
                throw Error(quoted(path_) + " has no picture that can be decoded.");
            return;
        }
        if (next.kind != Kind::picture)
            child_.refuse("no picture");
        if (!first_)
            first_ = next.time;
        // Damaged files have times that go back.
        last_ = std::max(last_, next.time - *first_);
        upcoming_ = last_;
    }

    void take() {
        upcoming_.reset();
        request(VideoRequest::next);
    }

    std::filesystem::path path_;
    ReadableFile file_;
    sandbox::Child child_;
    VideoAnswer opened_;
    std::optional<Duration> first_, upcoming_;
    Duration last_{};
    std::uint64_t lost_ = 0, lost_before_ = 0;  // in this round, in those before it
    bool waiting_ = false;                      // an answer is outstanding
    bool ended_ = false;
};

}  // namespace

std::unique_ptr<Camera> open_video_camera(Options& options, const Progress&) {
    const PlaybackOptions playback = take_playback_options(options);
    const double width_m = options.take_number("width", usual_screen_width_m, least_screen_width_m,
                                               largest_screen_width_m);
    options.require_no_problem();
    if (options.value().empty())
        throw LastingError("A shared video needs a file, as in video:FILE.");
    const std::filesystem::path path = options.value();
    auto video = std::make_unique<VideoRecording>(path);
    (void)video->offset();  // throws if there is no picture
    CameraInfo info;
    info.name = path.stem().string();
    info.calibration = screen_calibration(video->size(), width_m, usual_screen_place);
    info.calibration.registered = false;
    info.frames_per_second = video->frames_per_second();
    return make_recorded_camera(std::move(info), std::move(video), playback);
}

std::string camera_of_shared(const std::string& source) {
    const std::string kind = Options::parse(source).kind();
    const bool is_live = source.find(':') != std::string::npos &&
                         (kind == "x11" || kind == "v4l2" || kind == "rtsp");
    return is_live ? source : "video:" + source;
}

}  // namespace theatron::capture
