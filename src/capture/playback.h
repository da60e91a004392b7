// SPDX-License-Identifier: Apache-2.0
// Plays a recording as a camera: computes when each frame is due, and skips frames that are
// late. The time is passed in.
#pragma once

#include <optional>
#include <string>

#include "base/options.h"
#include "base/time.h"
#include "capture/camera.h"
#include "capture/clock.h"
#include "image/frame.h"

namespace theatron::capture {

// The frames of a recording in order. All functions throw Error, with one sentence, if the
// recording is damaged.
class Recording {
public:
    virtual ~Recording() = default;

    // The capture time of the next frame, relative to the recording's first frame; never
    // decreases. Nullopt at the end.
    virtual std::optional<Duration> offset() = 0;
    // Skips the next frame, without decoding it if possible.
    virtual void skip() = 0;
    // Reads the next frame's images into `out`, whose memory is reused. False: they are damaged and
    // left out, as lost_pictures() counts; the content of `out` is unspecified then.
    virtual bool read(Frame& out) = 0;
    // The next frame without a copy, if the recording stores it and no earlier caller still holds
    // it; the caller may set its times. Null: call read().
    virtual std::shared_ptr<Frame> share() { return nullptr; }
    virtual void rewind() = 0;
    // The next frame is the last one that is not after `position`, or one near it.
    virtual void go_to(Duration position);
    // The duration of one round of a loop, so that the cameras of one recording stay in step.
    // Nullopt: one period after the last frame.
    virtual std::optional<Duration> round() const { return std::nullopt; }
    // As in Camera. In further rounds they count no more.
    virtual std::uint64_t lost_pictures() const { return 0; }
    // One sentence for the user if the recording has no end, or one that was not wanted.
    virtual std::string problem_at_end() const { return ""; }
};

// Options of all recorded cameras.
struct PlaybackOptions {
    bool loop = false;                 // continue at the beginning after the end
    int start = 0;                     // frames to skip at the beginning
    std::optional<bool> preload = {};  // read all frames when opening; default: if it is small
};
PlaybackOptions take_playback_options(Options& options);

class Playback {
public:
    // `period`: the nominal time between frames.
    Playback(Recording& recording, Duration period, bool loop, int start)
        : recording_(recording), period_(period), loop_(loop), to_pass_over_(start) {}

    struct Upcoming {
        FrameNumber number = 0;  // includes skipped frames
        TimePoint due;
    };

    // The next frame to deliver, after skipping frames more than one period late at `now`. The
    // first call starts playback. Nullopt at the end.
    std::optional<Upcoming> upcoming(TimePoint now);

    // Frames are due when `zero` plus their offset is; this round goes on from where the recording
    // is.
    void set_zero(TimePoint zero);

    // From now on no frame is skipped.
    void skip_none() { skips_ = false; }

    // Reads the next frame's images. Precondition: upcoming() returned a frame. False: as in
    // Recording.
    bool read(Frame& out);
    // The next frame without a copy, or null (Recording::share).
    std::shared_ptr<Frame> share();
    // For a frame that is delivered beside those of upcoming().
    FrameNumber take_number() { return number_++; }

private:
    bool rewind();
    void note_played();

    Recording& recording_;
    Duration period_;
    bool loop_;
    int to_pass_over_;
    bool skips_ = true;  // late frames
    FrameNumber number_ = 0;
    bool begun_ = false;
    TimePoint zero_;                     // due time of offset 0 in this round
    Duration last_offset_{};             // of the previous frame
    std::optional<TimePoint> last_due_;  // of the last frame that was read
};

// A recording stored in memory.
class MemoryRecording final : public Recording {
public:
    // Reads all of `source`.
    MemoryRecording(Recording& source, std::size_t expected_frames, const Progress& progress);

    std::size_t frames() const { return frames_.size(); }

    std::optional<Duration> offset() override;
    void skip() override { ++next_; }
    bool read(Frame& out) override;
    std::shared_ptr<Frame> share() override;
    void rewind() override { next_ = 0; }
    void go_to(Duration position) override;
    std::optional<Duration> round() const override { return round_; }
    std::uint64_t lost_pictures() const override { return lost_pictures_; }
    std::string problem_at_end() const override { return problem_at_end_; }

private:
    struct Kept {
        Duration offset;
        std::shared_ptr<Frame> frame;
    };
    std::vector<Kept> frames_;
    std::size_t next_ = 0;
    std::optional<Duration> round_;
    std::uint64_t lost_pictures_ = 0;
    std::string problem_at_end_;
};

// A camera that plays a recording, at the pace of the clock.
std::unique_ptr<Camera> make_recorded_camera(CameraInfo info, std::unique_ptr<Recording> recording,
                                             const PlaybackOptions& options,
                                             Clock clock = steady_clock());

}  // namespace theatron::capture
